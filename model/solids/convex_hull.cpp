#include "model/solids/convex_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double same_mm = 1e-7;  // mm: far above rounding of sheets of metres, far below any printer

std::vector<Vector3d> distinct(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> out;
  for (const Vector3d& p : points)
    if (std::none_of(out.begin(), out.end(),
                     [&](const Vector3d& q) { return (p - q).cwiseAbs().maxCoeff() <= same_mm; }))
      out.push_back(p);
  return out;
}

/// Points in the plane, where all others are below it; else nothing.
std::vector<int> points_of_face(const std::vector<Vector3d>& points, const Vector3d& at, const Vector3d& normal) {
  std::vector<int> in;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double above = normal.dot(points[k] - at);
    if (above > same_mm) return {};
    if (above >= -same_mm) in.push_back(static_cast<int>(k));
  }
  return in;
}

/// In their order round the normal, without those between two others.
std::vector<int> in_order(const std::vector<Vector3d>& points, std::vector<int> in, const Vector3d& normal) {
  Vector3d middle = Vector3d::Zero();
  for (const int k : in) middle += points[k] / static_cast<double>(in.size());
  const Vector3d u = (points[in.front()] - middle).normalized(), v = normal.cross(u);
  const auto angle = [&](int k) {
    return std::atan2(v.dot(points[k] - middle), u.dot(points[k] - middle));
  };
  std::sort(in.begin(), in.end(), [&](int a, int b) { return angle(a) < angle(b); });
  std::vector<int> corners;
  for (std::size_t k = 0; k < in.size(); ++k) {
    const Vector3d &before = points[in[(k + in.size() - 1) % in.size()]], &here = points[in[k]],
                   &after = points[in[(k + 1) % in.size()]];
    const Vector3d along = (after - before).normalized();
    if (along.cross(here - before).norm() > same_mm) corners.push_back(in[k]);
  }
  return corners;
}

/// Faces with the same corners are one.
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
      const std::vector<int> face = in_order(points_, in, normal);
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
