#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace kinetix::model {

/// Returns the area of the parallelogram of two vectors, positive if b is left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

inline Eigen::Vector2d turned_by_90(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// Returns the distance from p to the nearest point of the wall from a to b. @pre a and b differ
inline double distance_to_wall(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double part = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - part * along).norm();
}

}  // namespace kinetix::model
