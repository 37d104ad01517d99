#pragma once

#include <vector>

#include "model/hinge/elasticity.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"
#include "sim/joints/row_system.hpp"

namespace kinetix::sim {

/// Directions of a hinge's own frame for the poses of its two bodies. Each is half way between the directions
/// carried by the two bodies: of the wall (made perpendicular to the axis) and of the axis. Unit vectors.
struct HingeDirections {
  Eigen::Vector3d wall, axis;  ///< dimensionless
};
HingeDirections hinge_directions(const model::RestHinge& hinge, const model::Pose& lower,
                                 const model::Pose& upper);

/// Pull of a hinge on its two bodies: derivatives of its stretch energy with the hinge's directions held.
/// They are by the mismatch of the hinge point and by that of the unit axis, lower minus upper.
struct HingePull {
  Eigen::Vector3d point;  ///< k_point edge
  Eigen::Vector3d axis;   ///< k_point edge^2
  /// Part of `point` from the stiffness in the hinge's frame, which need not be along the mismatch: k_point
  /// edge. Left zero for hinges with clearance.
  Eigen::Vector3d framed_point = Eigen::Vector3d::Zero();
  Eigen::Vector3d framed_axis = Eigen::Vector3d::Zero();  ///< that part of `axis`, k_point edge^2
};
HingePull hinge_pull(const model::RestHinge& hinge, const model::Stiffness& stiffness,
                     const model::Pose& lower, const model::Pose& upper, double edge_mm);

/// Appends the equations of the two points of a hinge with stiffness in its own frame
/// (model/hinge/elasticity.hpp). Each is an undamped spring by implicit Euler. Every point has three of the
/// shear stiffness in space. One along the wall's direction and one along the axis add the difference to
/// their stiffness, with a negative weight if that is smaller. A hinge with a separate tilt stiffness has
/// these equations for its hinge point and its axis instead. A hinge with clearance
/// (model/hinge/play_energy.hpp) has springs beyond the clearance at each point, across the axis and along
/// it. A brake acts on sliding round in its bore.
/// @param edge_mm cell edge  @param state mm  @param speeds rad/s and cell edges/s  @param step s
void append_framed_points(const model::RestHinge& hinge, const model::Stiffness& stiffness, double edge_mm,
                          const model::State& state, const std::vector<model::Twist>& speeds, double step,
                          std::vector<VelocityRow>& rows);

}  // namespace kinetix::sim
