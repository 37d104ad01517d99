#pragma once

#include "app/files/goal_settings.hpp"
#include "optim/space_curve/fit_space_curve.hpp"

namespace kinetix::app {

/// Content of a target.yaml of kind space_curve, with defaults filled in. Angles in radians, lengths in mm. Required
/// are `kinetix: 1` and a `target`.
///
///     target: {kind: space_curve, points: helix.csv}
///     structure: {cells: [96, 1], cell_mm: 6}
///     variables: {beta: {range_deg: [-60, 60]}, t: {range: [0.12, 0.88]}, theta: {range_deg: [20, 40]}}
///     tolerance: {shape: 0.01, verify: 0.02}
struct SpaceCurveFile : GoalSettings {
  explicit SpaceCurveFile(targets::SpaceGoal goal) : wanted(std::move(goal)) {}

  targets::SpaceGoal wanted;                          ///< target.points
  optim::SpaceVariables variables = {};               ///< structure and variables
  std::optional<optim::SpaceObstacle> obstacle = {};  ///< to a strip with these variables
  double shape_tolerance = 0.01;  ///< largest shape_rms, over the goal's bounding-box diagonal, (0, 1]
};

/// Returns all keys of a target.yaml of kind space_curve.
const targets::KeyTable& space_curve_keys();

/// Reads the target. @param root a target whose kind is space_curve
/// @throws InvalidInput for whatever formats.md does not allow
SpaceCurveFile read_space_curve_file(const targets::Node& root);

/// Makes the goal: the search, the closed form, and the simulation of its folding.
std::unique_ptr<Goal> make_goal(SpaceCurveFile file);

}  // namespace kinetix::app
