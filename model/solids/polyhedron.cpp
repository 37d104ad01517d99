#include "model/solids/polyhedron.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace kinetix::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void Polyhedron::add_face(const std::vector<int>& corners) {
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    triangles.push_back({corners[0], corners[k], corners[k + 1]});
}

int Polyhedron::add_point(const Vector3d& point) {
  points.push_back(point);
  return static_cast<int>(points.size()) - 1;
}

bool is_closed(const Polyhedron& solid) {
  std::vector<std::pair<int, int>> forward, backward;
  for (const auto& t : solid.triangles)
    for (int k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3];
      if (from == to) return false;
      forward.emplace_back(from, to);
      backward.emplace_back(to, from);
    }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return !forward.empty() && forward == backward &&
         std::adjacent_find(forward.begin(), forward.end()) == forward.end();
}

void append(const Polyhedron& part, Polyhedron& whole) {
  const int first = static_cast<int>(whole.points.size());
  whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
  for (const auto& [a, b, c] : part.triangles) whole.triangles.push_back({first + a, first + b, first + c});
}

MassProperties mass_properties(const Polyhedron& solid) {
  MassProperties out;
  if (solid.points.empty()) return out;
  const Vector3d origin = solid.points.front();  // near the solid: reduces rounding errors
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (const auto& t : solid.triangles) {
    const Vector3d a = solid.points[t[0]] - origin, b = solid.points[t[1]] - origin,
                   c = solid.points[t[2]] - origin, sum = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6;  // of the tetrahedron from the origin
    out.volume_mm3 += volume;
    first += volume / 4 * sum;
    second +=
        volume / 20 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  const Vector3d center = first / out.volume_mm3;
  second -= out.volume_mm3 * center * center.transpose();
  out.center = origin + center;
  out.inertia = second.trace() * Matrix3d::Identity() - second;
  return out;
}

double volume_mm3(const Polyhedron& solid) { return mass_properties(solid).volume_mm3; }

namespace {

constexpr double same_mm = 1e-7;  // mm: far above rounding of sheets of metres, far below any printer

std::vector<Vector3d> distinct(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> out;
  for (const Vector3d& p : points)
    if (std::none_of(out.begin(), out.end(),
                     [&](const Vector3d& q) { return (p - q).cwiseAbs().maxCoeff() <= same_mm; }))
      out.push_back(p);
  return out;
}

/// Returns the points in the plane if all others are below it, otherwise nothing.
std::vector<int> points_of_face(const std::vector<Vector3d>& points, const Vector3d& at,
                                const Vector3d& normal) {
  std::vector<int> in;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double above = normal.dot(points[k] - at);
    if (above > same_mm) return {};
    if (above >= -same_mm) in.push_back(static_cast<int>(k));
  }
  return in;
}

/// Returns the corners of the points' hull in the plane, counter-clockwise around the normal (Andrew's monotone
/// chain).
std::vector<int> corners_of_face(const std::vector<Vector3d>& points, std::vector<int> in,
                                 const Vector3d& normal) {
  const Vector3d u = (points[in[1]] - points[in[0]]).normalized(), v = normal.cross(u);
  const auto before = [&](int a, int b) {
    const double apart = u.dot(points[a] - points[b]);
    return apart < -same_mm || (apart <= same_mm && v.dot(points[a] - points[b]) < 0);
  };
  const auto turns_left = [&](int a, int b, int c) {
    const Vector3d first = points[b] - points[a], second = points[c] - points[a];
    return normal.dot(first.cross(second)) > same_mm * second.norm();
  };
  std::sort(in.begin(), in.end(), before);
  std::vector<int> out;
  const auto add = [&](int p, std::size_t first) {
    while (out.size() >= first + 2 && !turns_left(out[out.size() - 2], out.back(), p)) out.pop_back();
    out.push_back(p);
  };
  for (const int p : in) add(p, 0);
  const std::size_t lower = out.size() - 1;
  for (auto p = in.rbegin() + 1; p != in.rend(); ++p) add(*p, lower);
  out.pop_back();
  return out;
}

/// Returns true if a face with the same corners exists.
bool is_known(const std::vector<std::vector<int>>& faces, std::vector<int> face) {
  std::sort(face.begin(), face.end());
  return std::any_of(faces.begin(), faces.end(), [&](std::vector<int> other) {
    std::sort(other.begin(), other.end());
    return other == face;
  });
}

class Faces {
 public:
  explicit Faces(const std::vector<Vector3d>& points) : points_(points) {}

  std::vector<std::vector<int>> all() && {
    const int n = static_cast<int>(points_.size());
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b)
        for (int c = b + 1; c < n; ++c) try_plane(a, b, c);
    return std::move(faces_);
  }

 private:
  void try_plane(int a, int b, int c) {
    const Vector3d cross = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    const double longest = std::max((points_[b] - points_[a]).norm(), (points_[c] - points_[a]).norm());
    if (!(cross.norm() > same_mm * longest)) return;  // on one line
    for (const double side : {1.0, -1.0}) {
      const Vector3d normal = side * cross.normalized();
      const std::vector<int> in = points_of_face(points_, points_[a], normal);
      if (in.size() < 3) continue;
      const std::vector<int> face = corners_of_face(points_, in, normal);
      if (!is_known(faces_, face)) faces_.push_back(face);
    }
  }

  const std::vector<Vector3d>& points_;
  std::vector<std::vector<int>> faces_;
};

}  // namespace

ConvexHull convex_hull(const std::vector<Vector3d>& points) {
  ConvexHull hull;
  hull.corners = distinct(points);
  hull.faces = Faces(hull.corners).all();
  if (hull.faces.size() < 4) throw std::logic_error("the convex hull of points in one plane has no inside");
  return hull;
}

}  // namespace kinetix::model
