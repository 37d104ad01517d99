#include "model/opening/cell_opening.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "model/base/polygon.hpp"

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
double most_between(const std::vector<Line>& lines, const Square& square) {
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
        if (part.most > best + precision / 2) part.most = std::min(part.most, most_between(lines, part));
        if (part.most > best + precision / 2) open.push(part);
      }
  }
  return std::max(0.0, 2 * (best - opening.half_thickness));
}

double area(const Opening& opening) { return signed_area(opening.outline()); }

}  // namespace kinetix::model
