#pragma once

#include <Eigen/Core>

#include "model/linkage/hinge_parameters.hpp"

namespace kinetix::model {

/// A hinge in the rest frames of its two bodies, lengths in cell edges.
struct RestHinge {
  int lower = 0, upper = 0;   ///< bodies
  Eigen::Vector3d edge;       ///< from the lower to the upper body's vertex: the derivative of both arms by t
  Eigen::Vector3d across;     ///< unit, z x edge: their derivative by the offset
  Eigen::Vector3d lower_arm;  ///< from the lower body's vertex to the hinge point
  Eigen::Vector3d upper_arm;
  Eigen::Vector3d axis;        ///< unit vector
  Eigen::Vector3d axis_alpha;  ///< its derivative by alpha, per rad
  Eigen::Vector3d axis_beta;   ///< and by beta, per rad
  bool ball = false;           ///< holds its point alone and turns every way; its axis says nothing
};

/// Whether a hinge axis, a unit vector, stands along z, to 1e-9 rad.
bool is_vertical(const Eigen::Vector3d& axis);
/// Whether that of the hinge does at rest; never of a ball.
bool is_vertical(const RestHinge& hinge);

}  // namespace kinetix::model
