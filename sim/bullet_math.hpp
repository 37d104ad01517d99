#pragma once

#include "model/state.hpp"

class btMatrix3x3;
class btTransform;
class btVector3;

namespace kinetix {

Eigen::Vector3d eigen(const btVector3& v);
Eigen::Matrix3d eigen(const btMatrix3x3& m);
/// @param transform in cell edges   @return in mm
Pose pose_of(const btTransform& transform, double edge_mm);

}  // namespace kinetix
