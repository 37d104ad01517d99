#pragma once

#include <vector>

#include "model/hinge/elasticity.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"
#include "sim/row_system.hpp"

namespace kinetix::sim {

/// The directions of a hinge's own frame where its two bodies stand: half way between what each of them
/// carries of the wall's direction (made perpendicular to the axis) and of the axis. Unit vectors.
struct HingeDirections {
  Eigen::Vector3d wall, axis;  ///< dimensionless
};
HingeDirections hinge_directions(const model::RestHinge& hinge, const model::Pose& lower,
                                 const model::Pose& upper);

/// What a gap pulls with, over 2 k_point: the gap itself where all ratios are 1. @param gap cell edges, or of
/// unit axes
Eigen::Vector3d pull(const model::PointRatios& ratios, const HingeDirections& directions,
                     const Eigen::Vector3d& gap);

/// Appends the equations of the two points of a hinge that pulls by the directions of its frame
/// (model/hinge/elasticity.hpp), each an undamped spring by implicit Euler: at each point three of the shear
/// stiffness in space, and one along the wall's direction and one along the axis with what these have beyond
/// it, which is a negative weight where they have less.
/// @param edge_mm cell edge  @param state mm  @param speeds rad/s and cell edges/s  @param step s
void append_framed_points(const model::RestHinge& hinge, const model::Stiffness& stiffness, double edge_mm,
                          const model::State& state, const std::vector<model::Twist>& speeds, double step,
                          std::vector<VelocityRow>& rows);

}  // namespace kinetix::sim
