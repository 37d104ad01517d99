#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace kinetix {

/// Returns the signed area of a closed polygon, in squared units of its corners. Counter-clockwise is
/// positive.
/// @param count number of corners
/// @param corner function that returns corner k as an Eigen::Vector2d; k from 0
template <class Corner>
double signed_area(std::size_t count, const Corner& corner) {
  double twice = 0;
  for (std::size_t k = 0, before = count - 1; k < count; before = k++) {
    const Eigen::Vector2d a = corner(before), b = corner(k);
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

/// Returns the signed area of a closed polygon that is given as a list of corners.
template <class Points>
double signed_area(const Points& points) {
  return signed_area(points.size(), [&](std::size_t k) -> const Eigen::Vector2d& { return points[k]; });
}

}  // namespace kinetix
