#pragma once

#include <Eigen/Core>

namespace kinetix {

/// Returns [v]x, the matrix that maps w to v x w.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}
/// Returns the rotation matrix of |v| rad about v.
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& v);
/// Returns the smallest rotation that turns one direction into another. The vectors may have any length but
/// 0.
Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
/// Returns J with omega = J dv for the change d(rotation_of(v)) = [omega]x rotation_of(v): the left Jacobian
/// of SO(3). v in rad.
Eigen::Matrix3d rotation_rate(const Eigen::Vector3d& v);

}  // namespace kinetix
