#pragma once

#include <Eigen/Core>

namespace kinetix {

/// [v]x: the matrix that takes w to v x w.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}
/// The rotation matrix of |v| rad about v.
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& v);
/// The least rotation that turns the direction of one vector into that of another, of any lengths but 0.
Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
/// J with omega = J dv for the change d(rotation_of(v)) = [omega]x rotation_of(v): the left Jacobian of
/// SO(3). v in rad.
Eigen::Matrix3d rotation_rate(const Eigen::Vector3d& v);

}  // namespace kinetix
