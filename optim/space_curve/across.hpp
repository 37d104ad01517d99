#pragma once

#include "targets/space_curve/space_goal.hpp"

namespace kinetix::optim {

/// Direction across a strip, which is constant during the fold, and the slope of the goal against it.
struct Across {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  ///< unit vector (dimensionless)
  double slope = 0;   ///< largest |d across / d along the curve seen along it| of the goal, ratio
  double arc_mm = 0;  ///< its position along the goal
};

/// Returns the direction with the smallest largest slope of the goal.
/// @param stretch mm over which slopes are averaged, > 0: features shorter than two columns do not count
Across least_slope(const targets::SpaceGoal& goal, double stretch);

/// Returns the frame of a strip with its width along `direction`. Unit columns: along the strip's plane,
/// across, up.
Eigen::Matrix3d frame_across(const targets::SpaceGoal& goal, const Eigen::Vector3d& direction);

}  // namespace kinetix::optim
