#pragma once

#include <vector>

#include "model/hinge/elasticity.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"
#include "sim/joints/row_system.hpp"

namespace kinetix::sim {

/// The directions of a hinge's own frame where its two bodies stand: half way between what each of them
/// carries of the wall's direction (made perpendicular to the axis) and of the axis. Unit vectors.
struct HingeDirections {
  Eigen::Vector3d wall, axis;  ///< dimensionless
};
HingeDirections hinge_directions(const model::RestHinge& hinge, const model::Pose& lower,
                                 const model::Pose& upper);

/// What a hinge pulls its two bodies with: the derivatives of its stretch energy by the mismatch of the hinge
/// point and by that of the unit axis, lower less upper, with the hinge's directions held.
struct HingePull {
  Eigen::Vector3d point;  ///< k_point edge
  Eigen::Vector3d axis;   ///< k_point edge^2
  /// What of point is by the directions of the hinge's frame, and need not lie along the mismatch: k_point edge. Not told
  /// of hinges with play
  Eigen::Vector3d framed_point = Eigen::Vector3d::Zero();
  Eigen::Vector3d framed_axis = Eigen::Vector3d::Zero();  ///< likewise of axis, k_point edge^2
};
HingePull hinge_pull(const model::RestHinge& hinge, const model::Stiffness& stiffness,
                     const model::Pose& lower, const model::Pose& upper, double edge_mm);

/// Appends the equations of the two points of a hinge that pulls by the directions of its frame
/// (model/hinge/elasticity.hpp), each an undamped spring by implicit Euler: at each point three of the shear
/// stiffness in space, and one along the wall's direction and one along the axis with what these have beyond
/// it, which is a negative weight where they have less. A hinge with a tilt stiffness of its own has the same
/// equations of its hinge point and of its axis instead. One with play (model/hinge/play_energy.hpp) has at each
/// point what lies beyond the play, across the axis and along it, and a brake on sliding round in its bore.
/// @param edge_mm cell edge  @param state mm  @param speeds rad/s and cell edges/s  @param step s
void append_framed_points(const model::RestHinge& hinge, const model::Stiffness& stiffness, double edge_mm,
                          const model::State& state, const std::vector<model::Twist>& speeds, double step,
                          std::vector<VelocityRow>& rows);

}  // namespace kinetix::sim
