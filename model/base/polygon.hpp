#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace kinetix {

/// Signed area of a closed polygon, in the square of its unit: positive where it runs counter-clockwise.
/// @param count of its corners   @param corner the k-th, as an Eigen::Vector2d; from 0
template <class Corner>
double signed_area(std::size_t count, const Corner& corner) {
  double twice = 0;
  for (std::size_t k = 0, before = count - 1; k < count; before = k++) {
    const Eigen::Vector2d a = corner(before), b = corner(k);
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

/// Likewise, of a list of corners.
template <class Points>
double signed_area(const Points& points) {
  return signed_area(points.size(), [&](std::size_t k) -> const Eigen::Vector2d& { return points[k]; });
}

}  // namespace kinetix
