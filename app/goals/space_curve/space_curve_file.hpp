#pragma once

#include <string>

#include "app/files/goal_settings.hpp"
#include "optim/space_curve/fit_space_curve.hpp"

namespace kinetix::app {

/// A target.yaml of kind space_curve, as asked for or by default. Angles in radians, lengths in mm. `kinetix: 1` and a
/// `target` are enough.
///
///     target: {kind: space_curve, points: helix.csv}
///     structure: {cells: [96, 1], cell_mm: 6}
///     variables: {beta: {range_deg: [-60, 60]}, t: {range: [0.12, 0.88]}, theta: {range_deg: [20, 40]}}
///     tolerance: {shape: 0.01, verify: 0.02}
struct SpaceCurveFile : GoalSettings {
  explicit SpaceCurveFile(targets::SpaceGoal goal) : wanted(std::move(goal)) {}

  targets::SpaceGoal wanted;             ///< target.points
  optim::SpaceVariables variables = {};  ///< structure and variables
  double shape_tolerance = 0.01;  ///< of shape_rms, over the diagonal of the goal's bounding box, (0, 1]
};

/// Every key of a target.yaml of kind space_curve.
const targets::KeyTable& space_curve_keys();

/// @param root a target whose kind is space_curve
/// @throws InvalidInput for whatever formats.md does not allow, and at the point where a goal is out of reach
SpaceCurveFile read_space_curve_file(const targets::Node& root);

/// Makes the goal: the search, the closed form, and the physics run of its folding.
std::unique_ptr<Goal> make_goal(SpaceCurveFile file);

}  // namespace kinetix::app
