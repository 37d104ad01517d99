#include "model/cell_opening.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace kinetix {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance_to(const Opening::Side& side, const Vector2d& point) {
  const Vector2d along = side.knee - side.vertex, from = point - side.vertex;
  const double at = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (from - at * along).norm();
}

/// A square of the plane with the clearance of its middle, negative outside.
struct Square {
  Vector2d middle;
  double half, clearance;

  Square(const Opening& opening, const Vector2d& at, double half_side)
      : middle(at), half(half_side), clearance(opening.clearance(at) * (opening.contains(at) ? 1 : -1)) {}
  /// No point of it has more.
  double most() const { return clearance + half * std::sqrt(2.0); }
  bool operator<(const Square& other) const { return most() < other.most(); }
};

}  // namespace

std::vector<Vector2d> Opening::outline() const {
  std::vector<Vector2d> points;
  for (std::size_t k = 0; k < sides.size(); k += 2) {
    points.push_back(sides[k].vertex);
    points.push_back(sides[k].knee);
    points.push_back(sides[k + 1].knee);
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
  double least = distance_to(sides[0], point);
  for (const Side& side : sides) least = std::min(least, distance_to(side, point));
  return least;
}

Opening opening(const Structure& structure, const State& state, const CellHinges& cell) {
  Opening out;
  const double L = structure.size.edge_mm;
  out.half_thickness = structure.size.thickness_mm / 2 / L;
  for (int k = 0; k < 4; ++k) {
    const Hinge& hinge = structure.hinges[cell.hinges[k]];
    const double t = hinge.parameters.t;
    for (const int end : {0, 1}) {
      Opening::Side& side = out.sides[2 * k + end];
      side.body = (k + end) % 4;
      side.hinge = k;
      const int body = cell.bodies[side.body];
      side.sign = body == hinge.lower ? 1 : -1;
      const double length = body == hinge.lower ? t : 1 - t;
      const Eigen::Vector3d vertex = state[body].p / L;
      const Eigen::Vector3d knee = vertex + side.sign * length * (state[body].R * edge_direction(hinge.wall.axis));
      side.vertex = vertex.head<2>();
      side.knee = knee.head<2>();
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
  std::priority_queue<Square> open;
  open.emplace(opening, (low + high) / 2, (high - low).maxCoeff() / 2);
  double best = 0;
  while (!open.empty() && open.top().most() > best + precision / 2) {
    const Square square = open.top();
    open.pop();
    best = std::max(best, square.clearance);
    const double half = square.half / 2;
    for (const double x : {-half, half})
      for (const double y : {-half, half}) {
        const Square part(opening, square.middle + Vector2d(x, y), half);
        best = std::max(best, part.clearance);
        if (part.most() > best + precision / 2) open.push(part);
      }
  }
  return std::max(0.0, 2 * (best - opening.half_thickness));
}

double area(const Opening& opening) {
  const std::vector<Vector2d> corners = opening.outline();
  double twice = 0;
  for (std::size_t k = 0, before = corners.size() - 1; k < corners.size(); before = k++)
    twice += cross(corners[before], corners[k]);
  return twice / 2;
}

}  // namespace kinetix
