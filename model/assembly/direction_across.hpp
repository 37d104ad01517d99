#pragma once

#include <Eigen/Geometry>

namespace kinetix::model {

/// The direction from one body of a hinge to the other as far as it is square to the hinge's axis, or any that is where it runs
/// along the axis. @param between from body to body, of any length   @param axis unit vector   @return unit vector
inline Eigen::Vector3d direction_across(const Eigen::Vector3d& between, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d across = between - between.dot(axis) * axis;
  return across.norm() > 1e-6 * between.norm() ? Eigen::Vector3d(across.normalized())
                                               : Eigen::Vector3d(axis.unitOrthogonal());
}

}  // namespace kinetix::model
