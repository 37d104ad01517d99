#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/state.hpp"
#include "targets/space_curve/space_goal.hpp"

namespace kinetix::targets {

/// Distance between a folded midline in space and a goal (formats.md: shape_rms, shape_max).
struct SpaceError {
  double rms = 0;       ///< two-sided closest-point distance, over the diagonal of the goal's bounding box
  double max = 0;       ///< the largest of these distances, over the same diagonal
  double scale_mm = 0;  ///< that diagonal
  bool settled = true;  ///< false when the alignment stopped at its iteration limit
  std::vector<Eigen::Vector3d> goal_mm;  ///< the goal's own points, placed over the midline
  std::vector<double> arc_mm;            ///< arc length along the goal of each of its samples
  std::vector<double> distance_mm;       ///< of the sample from the midline
};

/// Both polylines are cut into 20 points a cell, evenly spaced by arc length, ends included; a point's distance is
/// that to the nearest place on the other polyline. The goal is moved rigidly, without reflection, from where
/// `place` has it, until the two-sided rms is least.
/// @param midline middle of each column of bodies, mm, at least 2; values that are not finite give NaN in rms and max
SpaceError space_error(const std::vector<Eigen::Vector3d>& midline, const SpaceGoal& goal,
                       const model::Pose& place);

}  // namespace kinetix::targets
