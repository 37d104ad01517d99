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

/// A target.yaml of kind fold, as asked for or by default. `kinetix: 1` and a `target` are enough.
///
///     target: {kind: fold, box: [4, 4, 4]}                     # or box_mm, net, solid: targets/fold/read_fold.hpp
///     structure: {cell_mm: 10, wall_mm: {thickness: 0.8, height: 6}}
///     variables: {beta: {range_deg: [-60, 60]}, theta: {range_deg: [2, 44]}}
///     tolerance: {angle_deg: 0.1, shape: 0.02, verify: 0.02}
struct FoldFile : GoalSettings {
  targets::FoldGoal goal;
  std::optional<optim::BoxOptions> box = {};  ///< of goal.box_mm: the box with walls for any cell edge
  std::array<double, 3> box_folded_mm =
      {};                     ///< of goal.box_mm: what its cells fold to, by a search of a small box
  model::CellSize size = {};  ///< structure.cell_mm (default 10), structure.wall_mm
  double tilt = 60 * radians_per_degree;  ///< rad: the nearer end of variables.beta.range_deg, which holds 0
                                          ///< inside: tilts alternate in sign along a crease; (0, 89] deg
  optim::AngleRange theta = {2 * radians_per_degree,
                             44 * radians_per_degree};  ///< rad, variables.theta, within (0, 45) deg
  double angle_tolerance = 0.1 * radians_per_degree;    ///< of a crease, rad, (0, 90] deg
  double shape_tolerance = 0.02;                        ///< of face_rms, over the edge of a face, (0, 1]
  double size_tolerance = 0.02;                         ///< of edges, over goal.box_mm, (0, 1]
  HingeLimits limits = {};                              ///< tolerance.force_N and tolerance.strain
};

/// Every key of a target.yaml of kind fold.
const targets::KeyTable& fold_keys();

/// @param root a target whose kind is fold
/// @throws InvalidInput for whatever formats.md does not allow
FoldFile read_fold_file(const targets::Node& root);

/// Makes the goal: the search, the closed form, and the physics run of its folding.
std::unique_ptr<Goal> make_goal(FoldFile file);

}  // namespace kinetix::app
