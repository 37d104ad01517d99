#include "model/assembly/cross_section.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <complex>

#include "model/base/angle.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Segment {
  Vector2d from, to;
};

Vector2d in_plane(const PlaneFrame& frame, const Vector3d& p) { return {frame.u.dot(p), frame.v.dot(p)}; }

/// Computes the segment in which the plane cuts a triangle, counter-clockwise about d with the solid on the left.
/// Corners in the plane count as above it, so that loops close. Returns false if there is no cut.
bool cuts(const std::array<Vector3d, 3>& corners, const PlaneFrame& frame, double at, Segment& out) {
  std::array<Vector2d, 2> ends;
  int found = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &p = corners[k], &q = corners[(k + 1) % 3];
    const double a = frame.d.dot(p) - at, b = frame.d.dot(q) - at;
    if ((a >= 0) == (b >= 0)) continue;
    ends[(a >= 0) ? 0 : 1] = in_plane(frame, p + a / (a - b) * (q - p));
    ++found;
  }
  // A triangle that is counter-clockwise from outside crosses the plane downwards at the start of its segment.
  out = {ends[0], ends[1]};
  return found == 2;
}

void add_moments(const Segment& s, double& area, Vector2d& first, Matrix2d& second) {
  const double part = (s.from.x() * s.to.y() - s.from.y() * s.to.x()) / 2;
  area += part;
  first += part * (s.from + s.to) / 3;
  const Vector2d sum = s.from + s.to;
  second += part / 12 * (sum * sum.transpose() + s.from * s.from.transpose() + s.to * s.to.transpose());
}

}  // namespace

PlaneFrame PlaneFrame::across(const Vector3d& d) {
  const Vector3d u = d.unitOrthogonal();
  return {u, d.cross(u), d};
}

CrossSection cross_section(const Polyhedron& solid, const PlaneFrame& frame, double at) {
  CrossSection out;
  Vector2d first = Vector2d::Zero();
  Matrix2d second = Matrix2d::Zero();
  std::complex<double> order = 0;
  double length = 0;
  const Vector2d origin = solid.points.empty() ? Vector2d::Zero() : in_plane(frame, solid.points.front());
  for (const auto& t : solid.triangles) {
    Segment s;
    if (!cuts({solid.points[t[0]], solid.points[t[1]], solid.points[t[2]]}, frame, at, s)) continue;
    s.from -= origin;
    s.to -= origin;
    add_moments(s, out.area_mm2, first, second);
    const Vector2d along = s.to - s.from;
    length += along.norm();
    order += along.norm() * std::polar(1.0, 4 * std::atan2(along.y(), along.x()));
  }
  if (!(out.area_mm2 > 0)) return {};
  const Vector2d center = first / out.area_mm2;
  out.center = origin + center;
  out.second = second - out.area_mm2 * center * center.transpose();
  out.edge_order = std::abs(order) / length;
  out.edge_angle = std::fmod(std::arg(order) / 4 + pi / 2, pi / 2);
  return out;
}

}  // namespace kinetix::model
