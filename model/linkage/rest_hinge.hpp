#pragma once

#include <Eigen/Core>

#include "model/linkage/hinge_parameters.hpp"

namespace kinetix::model {

/// A hinge in the rest frames of its two bodies; lengths are in cell edges.
struct RestHinge {
  int lower = 0, upper = 0;   ///< bodies
  Eigen::Vector3d edge;       ///< from the lower to the upper body's vertex; derivative of both arms by t
  Eigen::Vector3d across;     ///< unit, z x edge; derivative of both arms by the offset
  Eigen::Vector3d lower_arm;  ///< from the lower body's vertex to the hinge point
  Eigen::Vector3d upper_arm;
  Eigen::Vector3d axis;        ///< unit vector
  Eigen::Vector3d axis_alpha;  ///< derivative of the axis by alpha, per rad
  Eigen::Vector3d axis_beta;   ///< derivative of the axis by beta, per rad
  bool ball = false;           ///< holds only its point and turns in every direction; its axis is unused
};

/// Returns true if a hinge axis, a unit vector, is along z, to 1e-9 rad.
bool is_vertical(const Eigen::Vector3d& axis);
/// Returns true if the hinge's axis is along z at rest; false for a ball joint.
bool is_vertical(const RestHinge& hinge);

}  // namespace kinetix::model
