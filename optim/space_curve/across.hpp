#pragma once

#include "targets/space_curve/space_goal.hpp"

namespace kinetix::optim {

/// The direction across a strip, which stays where it is while the strip folds, and what it asks of the strip.
struct Across {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  ///< unit vector (dimensionless)
  double slope = 0;  ///< largest |d across / d along the curve seen along it| of a stretch of the goal, ratio
  double arc_mm = 0;  ///< along the goal, where that is
};

/// The direction along which the goal climbs least: of all directions the one with the smallest largest slope.
/// @param stretch mm over which slopes are taken, > 0: what is shorter than two columns does not count
Across least_slope(const targets::SpaceGoal& goal, double stretch);

/// The frame of a strip whose width is along `direction`: unit columns along the strip's plane, across, and up.
Eigen::Matrix3d frame_across(const targets::SpaceGoal& goal, const Eigen::Vector3d& direction);

}  // namespace kinetix::optim
