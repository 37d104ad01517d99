#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <vector>

#include "model/base/geometry.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::testing {

/// Returns a solid along s whose section in (m, n) goes from n = -half(m) to half(m), at each of the given m,
/// ascending. mm
inline model::Polyhedron strip_solid(const std::vector<double>& ms, const std::function<double(double)>& half,
                                     double height) {
  model::Polyhedron solid;
  const auto corner = [](std::size_t k, int side, int top) {
    return static_cast<int>(4 * k) + 2 * side + top;
  };
  for (const double m : ms)
    for (const double n : {-half(m), half(m)})
      for (const double s : {-height / 2, height / 2}) solid.points.emplace_back(m, n, s);
  for (std::size_t k = 0; k + 1 < ms.size(); ++k) {
    const auto at = [&](std::size_t l, int side, int top) { return corner(k + l, side, top); };
    solid.add_face({at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
    solid.add_face({at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), at(0, 1, 0)});
    solid.add_face({at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
    solid.add_face({at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), at(0, 0, 0)});
  }
  const std::size_t last = ms.size() - 1;
  solid.add_face({corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)});
  solid.add_face({corner(last, 0, 0), corner(last, 1, 0), corner(last, 1, 1), corner(last, 0, 1)});
  return solid;
}

/// Returns a box from one m to another, with this thickness and height.
inline model::Polyhedron box_solid(double from, double to, double thickness, double height) {
  return strip_solid(
      {from, to}, [=](double) { return thickness / 2; }, height);
}

inline model::Polyhedron moved(model::Polyhedron solid, const Eigen::Isometry3d& motion) {
  for (Eigen::Vector3d& p : solid.points) p = motion * p;
  return solid;
}

/// Returns the section of a round bar about s as a polygon of `sides` sides. Its corners are on the circle, or its
/// sides touch it.
inline std::vector<Eigen::Vector2d> ring(double radius, int sides, bool corners_on_it) {
  std::vector<Eigen::Vector2d> out;
  const double r = corners_on_it ? radius : radius / std::cos(pi / sides);
  for (int k = 0; k < sides; ++k)
    out.emplace_back(r * std::cos(2 * pi * k / sides), r * std::sin(2 * pi * k / sides));
  return out;
}

/// Returns the solid between two rings of equally many corners, the inner one empty for a full bar. @param from, to of
/// s, mm
inline model::Polyhedron tube(const std::vector<Eigen::Vector2d>& outer,
                              const std::vector<Eigen::Vector2d>& inner, double from, double to) {
  model::Polyhedron solid;
  const int n = static_cast<int>(outer.size());
  const auto add_ring = [&](const std::vector<Eigen::Vector2d>& ring, double s) {
    const int first = static_cast<int>(solid.points.size());
    for (const auto& p : ring) solid.points.emplace_back(p.x(), p.y(), s);
    return first;
  };
  const int low = add_ring(outer, from), high = add_ring(outer, to);
  const int in_low = add_ring(inner, from), in_high = add_ring(inner, to);
  for (int k = 0; k < n; ++k) {
    const int l = (k + 1) % n;
    solid.add_face({low + k, low + l, high + l, high + k});
    if (inner.empty()) continue;
    solid.add_face({in_low + l, in_low + k, in_high + k, in_high + l});
    solid.add_face({low + l, low + k, in_low + k, in_low + l});
    solid.add_face({high + k, high + l, in_high + l, in_high + k});
  }
  if (!inner.empty()) return solid;
  std::vector<int> bottom, top;
  for (int k = 0; k < n; ++k) {
    top.push_back(high + k);
    bottom.push_back(low + n - 1 - k);
  }
  solid.add_face(bottom);
  solid.add_face(top);
  return solid;
}

}  // namespace kinetix::testing
