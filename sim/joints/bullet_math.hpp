#pragma once

#include "model/linkage/state.hpp"

class btMatrix3x3;
class btTransform;
class btVector3;

namespace kinetix::sim {

Eigen::Vector3d eigen(const btVector3& v);
Eigen::Matrix3d eigen(const btMatrix3x3& m);
/// Converts a pose. @param transform in cell edges   @return in mm
model::Pose pose_of(const btTransform& transform, double edge_mm);
/// Converts a pose in mm to a transform in cell edges.
btTransform transform_of(const model::Pose& mm, double edge_mm);

}  // namespace kinetix::sim
