#include "model/opening/cell_opening.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <queue>

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

/// A straight part of an outline, possibly one point.
struct Line {
  Vector2d from, to;

  double distance(const Vector2d& point) const {
    const Vector2d along = to - from, at = point - from;
    const double square = along.squaredNorm();
    const double share = square > 0 ? std::clamp(at.dot(along) / square, 0.0, 1.0) : 0;
    return (at - share * along).norm();
  }
};

/// Visits the half walls, then the lines that close the joint separations. @param visit takes a Line
template <class Visit>
void visit_lines(const Opening& opening, const Visit& visit) {
  for (const Opening::Side& side : opening.sides) visit(Line{side.vertex, side.wall_tip});
  for (std::size_t k = 0; k < opening.sides.size(); k += 2)
    visit(Line{opening.sides[k].wall_tip, opening.sides[k + 1].wall_tip});
}

/// A square of the plane with the clearance of its middle, negative outside, and an upper bound for its
/// points.
struct Square {
  Vector2d middle;
  double half, clearance, most;

  Square(const Opening& opening, const Vector2d& at, double half_side)
      : middle(at),
        half(half_side),
        clearance(opening.clearance(at) * (opening.contains(at) ? 1 : -1)),
        most(clearance + half * std::sqrt(2.0)) {}
  bool operator<(const Square& other) const { return most < other.most; }
};

/// Returns an upper bound of the clearance in a square. It is the mean distance from the line nearest to the
/// middle and from another line, which is convex and so largest at a corner. Between parallel walls the bound
/// equals the clearance. A bound by the size of the square alone would subdivide the whole middle line there.
double max_between(const std::vector<Line>& lines, const Square& square) {
  Eigen::Array<double, Eigen::Dynamic, 4> far(static_cast<Eigen::Index>(lines.size()), 4);
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    int corner = 0;
    for (const double x : {-square.half, square.half})
      for (const double y : {-square.half, square.half})
        far(static_cast<Eigen::Index>(k), corner++) = lines[k].distance(square.middle + Vector2d(x, y));
    if (lines[k].distance(square.middle) < lines[nearest].distance(square.middle)) nearest = k;
  }
  const Eigen::Array<double, 1, 4> near = far.row(static_cast<Eigen::Index>(nearest));
  return ((far.rowwise() + near) / 2).rowwise().maxCoeff().minCoeff();
}

}  // namespace

std::vector<Vector2d> Opening::outline() const {
  std::vector<Vector2d> points;
  for (std::size_t k = 0; k < sides.size(); k += 2) {
    points.push_back(sides[k].vertex);
    points.push_back(sides[k].wall_tip);
    points.push_back(sides[k + 1].wall_tip);
  }
  return points;
}

bool Opening::contains(const Vector2d& point) const {
  const std::vector<Vector2d> corners = outline();
  bool inside = false;
  for (std::size_t k = 0, before = corners.size() - 1; k < corners.size(); before = k++) {
    const Vector2d &a = corners[k], &b = corners[before];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    inside ^= point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
  }
  return inside;
}

double Opening::clearance(const Vector2d& point) const {
  double least = Line{sides[0].vertex, sides[0].wall_tip}.distance(point);
  visit_lines(*this, [&](const Line& line) { least = std::min(least, line.distance(point)); });
  return least;
}

Opening opening(const Linkage& structure, const State& state, const LinkageCell& cell) {
  Opening out;
  const double L = structure.size.edge_mm;
  out.half_thickness = structure.size.thickness_mm / 2 / L;
  const int walls = static_cast<int>(cell.hinges.size());
  out.sides.resize(2 * cell.hinges.size());
  for (int k = 0; k < walls; ++k) {
    const RestHinge& hinge = structure.hinges[cell.hinges[k]];
    for (const int end : {0, 1}) {
      Opening::Side& side = out.sides[2 * k + end];
      side.body = (k + end) % walls;
      side.hinge = k;
      const int body = cell.bodies[side.body];
      const Plate& plate = structure.plates[2 * cell.hinges[k] + (body == hinge.lower ? 0 : 1)];
      side.sign = plate.length_t;
      const Eigen::Vector3d vertex = state[body].p / L;
      const Eigen::Vector3d wall_tip = vertex + plate.length * (state[body].R * plate.edge);
      side.vertex = vertex.head<2>();
      side.wall_tip = wall_tip.head<2>();
    }
  }
  return out;
}

double aperture(const Opening& opening, double precision) {
  Vector2d low = opening.sides[0].vertex, high = low;
  for (const Vector2d& corner : opening.outline()) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  if (!low.allFinite() || !high.allFinite()) return NAN;
  std::vector<Line> lines;
  visit_lines(opening, [&](const Line& line) { lines.push_back(line); });
  std::priority_queue<Square> open;
  open.emplace(opening, (low + high) / 2, (high - low).maxCoeff() / 2);
  double best = 0;
  while (!open.empty() && open.top().most > best + precision / 2) {
    const Square square = open.top();
    open.pop();
    best = std::max(best, square.clearance);
    const double half = square.half / 2;
    for (const double x : {-half, half})
      for (const double y : {-half, half}) {
        Square part(opening, square.middle + Vector2d(x, y), half);
        best = std::max(best, part.clearance);
        if (part.most > best + precision / 2) part.most = std::min(part.most, max_between(lines, part));
        if (part.most > best + precision / 2) open.push(part);
      }
  }
  return std::max(0.0, 2 * (best - opening.half_thickness));
}

double area(const Opening& opening) { return signed_area(opening.outline()); }

namespace {

using Eigen::Matrix2d;

constexpr int max_steps = 40;          // Newton's method needs a few at the end; the rest climb uphill before
constexpr double settled = 1e-12;      // slope of the clearance, and cell edges of a step: rounding
constexpr double longest_climb = 0.1;  // cell edges: a longer step may leave the pocket that it climbs

/// A straight piece of the outline: a half wall from its vertex to its wall tip, or the line that closes the
/// separation of a hinge.
struct Piece {
  Vector2d from, to;
  double weight = 1;
  double by_length = 0;  ///< derivative of the weight by the length, per cell edge
};

/// The half walls in the order of Opening::sides, then the gaps.
using Pieces = std::vector<Piece>;

Piece gap_piece(const Vector2d& from, const Vector2d& to, double sharpness) {
  const double length = (to - from).norm(), left = std::exp(-std::pow(sharpness * length, 2));
  return {from, to, 1 - left, 2 * sharpness * sharpness * length * left};
}

Pieces pieces_of(const Opening& opening, double sharpness) {
  const auto& sides = opening.sides;
  Pieces pieces;
  pieces.reserve(sides.size() + sides.size() / 2);
  for (const Opening::Side& side : sides) pieces.push_back({side.vertex, side.wall_tip});
  for (std::size_t k = 0; k < sides.size(); k += 2)
    pieces.push_back(gap_piece(sides[k].wall_tip, sides[k + 1].wall_tip, sharpness));
  return pieces;
}

/// Distance from a piece to a point, with the position of the closest point (0 to 1) and its direction.
struct Distance {
  double value, at;
  Vector2d normal;

  Distance(const Piece& piece, const Vector2d& point) {
    const Vector2d along = piece.to - piece.from, from = point - piece.from;
    const double square = along.squaredNorm();
    at = square > 0 ? std::clamp(from.dot(along) / square, 0.0, 1.0) : 0;
    const Vector2d apart = from - at * along;
    value = apart.norm();
    normal = apart / std::max(value, 1e-12);
  }
  bool at_end() const { return at <= 0 || at >= 1; }
};

/// Soft minimum of the distances at a point, with gradient and Hessian by the point.
struct Clearance {
  double value = 0;
  Vector2d gradient = Vector2d::Zero();
  Matrix2d hessian = Matrix2d::Zero();
  std::vector<double> shares;  ///< exp(-s d) over the weighted sum, without the weight

  Clearance(const Pieces& pieces, const Vector2d& point, double sharpness) {
    std::vector<Distance> distances;
    distances.reserve(pieces.size());
    shares.resize(pieces.size());
    for (const Piece& piece : pieces) distances.emplace_back(piece, point);
    double least = std::numeric_limits<double>::infinity(), sum = 0;
    for (const Distance& d : distances) least = std::min(least, d.value);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      shares[k] = std::exp(-sharpness * (distances[k].value - least));
      sum += pieces[k].weight * shares[k];
    }
    value = least - std::log(sum) / sharpness;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Distance& d = distances[k];
      shares[k] /= sum;
      const double weight = pieces[k].weight * shares[k];
      if (weight == 0) continue;
      const Matrix2d across = d.normal * d.normal.transpose();
      gradient += weight * d.normal;
      hessian -= sharpness * weight * across;
      if (d.at_end()) hessian += weight / d.value * (Matrix2d::Identity() - across);
    }
    hessian += sharpness * gradient * gradient.transpose();
  }
};

struct Pocket {
  Vector2d middle;
  Clearance clearance;
};

/// Returns Newton's step if the Hessian curves down, otherwise a step uphill.
Vector2d step_from(const Clearance& c) {
  const bool curves_down = c.hessian.determinant() > 0 && c.hessian.trace() < 0;
  Vector2d step = c.gradient;
  if (curves_down) step = -c.hessian.inverse() * c.gradient;
  return step.norm() > longest_climb ? Vector2d(step * longest_climb / step.norm()) : step;
}

Pocket climb(const Pieces& pieces, const Vector2d& start, double sharpness) {
  Pocket pocket{start, Clearance(pieces, start, sharpness)};
  for (int k = 0; k < max_steps && pocket.clearance.gradient.norm() > settled; ++k) {
    Vector2d step = step_from(pocket.clearance);
    Pocket next{pocket.middle + step, Clearance(pieces, pocket.middle + step, sharpness)};
    while (!(next.clearance.value > pocket.clearance.value) && step.norm() > settled) {
      step /= 4;
      next = {pocket.middle + step, Clearance(pieces, pocket.middle + step, sharpness)};
    }
    if (!(next.clearance.value > pocket.clearance.value)) break;
    pocket = next;
  }
  return pocket;
}

std::vector<Vector2d> starts(const Opening& opening) {
  Vector2d middle = Vector2d::Zero();
  const auto walls = static_cast<double>(opening.sides.size() / 2);
  for (std::size_t k = 0; k < opening.sides.size(); k += 2) middle += opening.sides[k].vertex / walls;
  std::vector<Vector2d> points = {middle};
  for (std::size_t k = 0; k < opening.sides.size(); k += 2)
    points.push_back(middle / 2 + (opening.sides[k].wall_tip + opening.sides[k + 1].wall_tip) / 4);
  return points;
}

std::optional<Pocket> widest_pocket(const Opening& opening, const Pieces& pieces, double sharpness) {
  std::optional<Pocket> widest;
  for (const Vector2d& start : starts(opening)) {
    if (!opening.contains(start)) continue;
    const Pocket pocket = climb(pieces, start, sharpness);
    if (!opening.contains(pocket.middle)) continue;
    if (!widest || pocket.clearance.value > widest->clearance.value) widest = pocket;
  }
  return widest;
}

/// Adds the derivatives due to a `force` at a point carried by a side's body.
void add_carried(const Opening::Side& side, const Vector2d& point, const Vector2d& force,
                 CellReading& reading) {
  reading.bodies.col(side.body) += Eigen::Vector3d(cross(point - side.vertex, force), force.x(), force.y());
}

/// Adds the derivatives due to a `force` at a side's wall tip, which also moves with t.
void add_wall_tip(const Opening::Side& side, const Vector2d& force, CellReading& reading) {
  add_carried(side, side.wall_tip, force, reading);
  reading.t[side.hinge] += side.sign * force.dot((side.wall_tip - side.vertex).normalized());
}

void add_wall(const Opening::Side& side, const Distance& d, double share, CellReading& reading) {
  const Vector2d force = -2 * share * d.normal;
  if (d.at >= 1) return add_wall_tip(side, force, reading);
  add_carried(side, side.vertex + d.at * (side.wall_tip - side.vertex), force, reading);
}

/// Adds the derivatives by the closest point and by the length of the separation, which sets its weight.
void add_gap(const Opening::Side& from, const Opening::Side& to, const Piece& gap, const Distance& d,
             double share, double sharpness, CellReading& reading) {
  const Vector2d along = gap.to - gap.from;
  if (along.squaredNorm() == 0) return;
  const Vector2d force = -2 * share * gap.weight * d.normal,
                 longer = -2 * share * gap.by_length / sharpness * along.normalized();
  add_wall_tip(from, (1 - d.at) * force - longer, reading);
  add_wall_tip(to, d.at * force + longer, reading);
}

}  // namespace

CellReading soft_aperture(const Opening& opening, double sharpness) {
  CellReading reading(opening.sides.size() / 2);
  const Pieces pieces = pieces_of(opening, sharpness);
  const std::optional<Pocket> pocket = widest_pocket(opening, pieces, sharpness);
  reading.value = pocket ? 2 * (pocket->clearance.value - opening.half_thickness) : NAN;
  if (!pocket) return reading;
  const auto& sides = opening.sides;
  const auto distance = [&](std::size_t k) { return Distance(pieces[k], pocket->middle); };
  const std::size_t walls = sides.size();
  for (std::size_t k = 0; k < walls; ++k)
    add_wall(sides[k], distance(k), pocket->clearance.shares[k], reading);
  for (std::size_t k = 0, gap = walls; gap < pieces.size(); k += 2, ++gap)
    add_gap(sides[k], sides[k + 1], pieces[gap], distance(gap), pocket->clearance.shares[gap], sharpness,
            reading);
  return reading;
}

CellReading area_reading(const Opening& opening) {
  CellReading reading(opening.sides.size() / 2);
  reading.value = area(opening);
  const std::size_t count = opening.sides.size();
  const auto corner = [&](std::size_t k, bool wall_tip) {
    const Opening::Side& side = opening.sides[k % count];
    return wall_tip ? side.wall_tip : side.vertex;
  };
  const auto add_corner = [&](std::size_t k, bool wall_tip, const Vector2d& before, const Vector2d& after) {
    const Opening::Side& side = opening.sides[k];
    const Vector2d by(0.5 * (after.y() - before.y()), 0.5 * (before.x() - after.x()));
    if (wall_tip) return add_wall_tip(side, by, reading);
    add_carried(side, side.vertex, by, reading);
  };
  for (std::size_t k = 0; k < count; k += 2) {
    add_corner(k, false, corner(k + count - 1, true), corner(k, true));
    add_corner(k, true, corner(k, false), corner(k + 1, true));
    add_corner(k + 1, true, corner(k, true), corner(k + 2, false));
  }
  return reading;
}

}  // namespace kinetix::model
