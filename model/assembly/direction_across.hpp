#pragma once

#include <Eigen/Geometry>

namespace kinetix::model {

/// Returns the component normal to the hinge's axis of the direction from one body to the other, as a unit vector.
/// Any normal direction is returned if they are aligned with the axis.
/// @param between from body to body, of any length   @param axis unit vector
inline Eigen::Vector3d direction_across(const Eigen::Vector3d& between, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d across = between - between.dot(axis) * axis;
  return across.norm() > 1e-6 * between.norm() ? Eigen::Vector3d(across.normalized())
                                               : Eigen::Vector3d(axis.unitOrthogonal());
}

}  // namespace kinetix::model
