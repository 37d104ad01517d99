#pragma once

#include <array>
#include <string>

#include "app/files/goal_settings.hpp"
#include "app/files/hinge_parts.hpp"
#include "model/lattice/square/structure.hpp"
#include "optim/fold/fit_box.hpp"
#include "optim/solvers/variables.hpp"
#include "targets/fold/fold_goal.hpp"

namespace kinetix::app {

/// Content of a target.yaml of kind fold, with defaults filled in. Required are `kinetix: 1` and a `target`.
///
///     target: {kind: fold, box: [4, 4, 4]}                     # or box_mm, net, solid: targets/fold/read_fold.hpp
///     structure: {cell_mm: 10, wall_mm: {thickness: 0.8, height: 6}}
///     variables: {beta: {range_deg: [-60, 60]}, theta: {range_deg: [2, 44]}}
///     tolerance: {angle_deg: 0.1, shape: 0.02, verify: 0.02}
struct FoldFile : GoalSettings {
  targets::FoldGoal goal;
  std::optional<optim::BoxOptions> box = {};  ///< for goal.box_mm: options of the search for its cells
  /// For goal.box_mm: edges that the cells fold to, mm, from a search of a small box.
  std::array<double, 3> box_folded_mm = {};
  model::CellSize size = {};  ///< structure.cell_mm (default 10), structure.wall_mm
  /// Rad, (0, 89] deg: the end of variables.beta.range_deg that is nearer to 0. The range includes 0, because tilts
  /// alternate in sign along a crease.
  double tilt = 60 * radians_per_degree;
  optim::AngleRange theta = {2 * radians_per_degree,
                             44 * radians_per_degree};  ///< rad, variables.theta, within (0, 45) deg
  double angle_tolerance = 0.1 * radians_per_degree;    ///< largest error of a crease, rad, (0, 90] deg
  double shape_tolerance = 0.02;                        ///< largest face_rms, over a face's edge, (0, 1]
  double size_tolerance = 0.02;  ///< largest error of an edge, over goal.box_mm, (0, 1]
  HingeLimits limits = {};       ///< tolerance.force_N and tolerance.strain
};

/// Returns all keys of a target.yaml of kind fold.
const targets::KeyTable& fold_keys();

/// Reads the target. @param root a target whose kind is fold
/// @throws InvalidInput for whatever formats.md does not allow
FoldFile read_fold_file(const targets::Node& root);

/// Makes the goal: the search, the closed form, and the simulation of its folding.
std::unique_ptr<Goal> make_goal(FoldFile file);

}  // namespace kinetix::app
