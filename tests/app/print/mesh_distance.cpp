#include "tests/app/print/mesh_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;
using model::Polyhedron;

using Triangle = std::array<Vector3d, 3>;

std::vector<Triangle> triangles_of(const Polyhedron& solid) {
  std::vector<Triangle> out;
  for (const auto& [a, b, c] : solid.triangles)
    out.push_back({solid.points[a], solid.points[b], solid.points[c]});
  return out;
}

Vector3d normal_of(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

/// Checks whether the foot of p on the triangle's plane is within the triangle.
bool is_over(const Vector3d& p, const Triangle& t) {
  const Vector3d n = normal_of(t);
  for (int k = 0; k < 3; ++k)
    if ((t[(k + 1) % 3] - t[k]).cross(p - t[k]).dot(n) < 0) return false;
  return true;
}

double height_over(const Vector3d& p, const Triangle& t) { return (p - t[0]).dot(normal_of(t).normalized()); }

/// Computes the distance of two segments (Ericson, Real-Time Collision Detection, section 5.1.9).
double distance(const Vector3d& p, const Vector3d& q, const Vector3d& r, const Vector3d& s) {
  const Vector3d u = q - p, v = s - r, w = p - r;
  const double a = u.squaredNorm(), e = v.squaredNorm(), f = v.dot(w), b = u.dot(v), c = u.dot(w),
               det = a * e - b * b;
  double x = det > 0 ? std::clamp((b * f - c * e) / det, 0.0, 1.0) : 0, y = (b * x + f) / e;
  if (y < 0 || y > 1) {
    y = std::clamp(y, 0.0, 1.0);
    x = std::clamp((b * y - c) / a, 0.0, 1.0);
  }
  return (w + x * u - y * v).norm();
}

double distance(const Triangle& a, const Triangle& b) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (is_over(a[i], b)) least = std::min(least, std::abs(height_over(a[i], b)));
    if (is_over(b[i], a)) least = std::min(least, std::abs(height_over(b[i], a)));
    for (int k = 0; k < 3; ++k) least = std::min(least, distance(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return least;
}

std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<Triangle>& triangles) {
  std::vector<Eigen::AlignedBox3d> out(triangles.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    for (const Vector3d& corner : triangles[k]) out[k].extend(corner);
  return out;
}

bool goes_through(const Vector3d& p, const Vector3d& q, const Triangle& t) {
  const double from = height_over(p, t), to = height_over(q, t);
  return from * to < 0 && is_over(p + from / (from - to) * (q - p), t);
}

/// Checks whether an edge of either triangle goes through the other.
bool cross(const Triangle& a, const Triangle& b) {
  for (int k = 0; k < 3; ++k)
    if (goes_through(a[k], a[(k + 1) % 3], b) || goes_through(b[k], b[(k + 1) % 3], a)) return true;
  return false;
}

}  // namespace

double surface_distance(const Polyhedron& a, const Polyhedron& b) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<Triangle> s = triangles_of(a), t = triangles_of(b);
  const std::vector<Eigen::AlignedBox3d> around_s = boxes_of(s), around_t = boxes_of(t);
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t k = 0; k < t.size(); ++k)
      if (around_s[i].exteriorDistance(around_t[k]) < least) least = std::min(least, distance(s[i], t[k]));
  return least;
}

bool surfaces_cross(const Polyhedron& a, const Polyhedron& b) {
  const std::vector<Triangle> s = triangles_of(a), t = triangles_of(b);
  const std::vector<Eigen::AlignedBox3d> around_s = boxes_of(s), around_t = boxes_of(t);
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t k = 0; k < t.size(); ++k)
      if (around_s[i].intersects(around_t[k]) && cross(s[i], t[k])) return true;
  return false;
}

double covered_share(const std::array<Vector3d, 4>& corners, const Polyhedron& solid) {
  constexpr int n = 40;
  constexpr double same_mm = 1e-6;  // mm: rounding error of two faces in one plane
  const Vector3d outwards = (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalized();
  std::vector<Triangle> facing;
  for (const Triangle& t : triangles_of(solid))
    if (normal_of(t).normalized().dot(outwards) < -1 + same_mm) facing.push_back(t);
  int covered = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double x = (i + 0.5) / n, y = (k + 0.5) / n;
      const Vector3d p =
          (1 - x) * ((1 - y) * corners[0] + y * corners[3]) + x * ((1 - y) * corners[1] + y * corners[2]);
      covered += std::any_of(facing.begin(), facing.end(), [&](const Triangle& t) {
        return std::abs(height_over(p, t)) < same_mm && is_over(p, t);
      });
    }
  return static_cast<double>(covered) / (n * n);
}

}  // namespace kinetix::testing
