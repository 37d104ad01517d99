#include "sim/joints/bullet_math.hpp"

#include <LinearMath/btTransform.h>

namespace kinetix::sim {

Eigen::Vector3d eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Matrix3d eigen(const btMatrix3x3& m) {
  Eigen::Matrix3d out;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) out(row, column) = m[row][column];
  return out;
}

model::Pose pose_of(const btTransform& transform, double edge_mm) {
  return {eigen(transform.getBasis()), edge_mm * eigen(transform.getOrigin())};
}

btTransform transform_of(const model::Pose& mm, double edge_mm) {
  const auto& R = mm.R;
  const Eigen::Vector3d p = mm.p / edge_mm;
  return btTransform(
      btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      btVector3(p.x(), p.y(), p.z()));
}

}  // namespace kinetix::sim
