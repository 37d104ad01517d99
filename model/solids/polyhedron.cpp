#include "model/solids/polyhedron.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>

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

}  // namespace kinetix::model
