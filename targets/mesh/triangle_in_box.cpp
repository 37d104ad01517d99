#include "targets/mesh/triangle_in_box.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

/// Most corners of a clipped triangle: six planes add one each to its three, and one is to spare.
constexpr int most_corners = 10;

struct Polygon {
  std::array<Vector3d, most_corners> corners;
  int count = 0;

  void add(const Vector3d& p) { corners[count++] = p; }
};

/// Cuts a polygon to its part with sign * coordinate <= limit (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, int coordinate, double sign, double limit) {
  Polygon kept;
  for (int k = 0; k < polygon.count; ++k) {
    const Vector3d &p = polygon.corners[k], &q = polygon.corners[(k + 1) % polygon.count];
    const double beyond_p = sign * p[coordinate] - limit, beyond_q = sign * q[coordinate] - limit;
    if (beyond_p <= 0) kept.add(p);
    if ((beyond_p <= 0) != (beyond_q <= 0)) kept.add(p + beyond_p / (beyond_p - beyond_q) * (q - p));
  }
  return kept;
}

}  // namespace

bool is_in_box(const std::array<Vector3d, 3>& corners, const OrientedBox& box) {
  Polygon left;
  for (const Vector3d& p : corners) left.add(box.axes.transpose() * (p - box.center));
  for (int c = 0; c < 3; ++c)
    for (const double sign : {-1.0, 1.0}) left = clipped(left, c, sign, box.half[c]);
  return left.count > 0;
}

}  // namespace kinetix::targets
