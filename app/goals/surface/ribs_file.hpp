#pragma once

#include "app/goals/surface/surface_file.hpp"
#include "optim/ribs/fit_ribs.hpp"

namespace kinetix::app {

/// Content of a target.yaml of kind surface with `target.ribs`: a fishbone over any surface.
///
///     target: {kind: surface, mesh: seat.obj, ribs: 8}
///     structure: {cell_mm: 7, wall_mm: {thickness: 0.6, height: 1}}
///     variables: {beta_deg: 75}
///     tolerance: {shape: 0.015, covered_share: 0.5, verify: 0.02}
struct RibsFile : GoalSettings {
  std::string surface_name;
  targets::RibbedSurface surface;
  optim::RibsSpec spec = {};       ///< target.ribs, structure, variables
  double shape_tolerance = 0.015;  ///< largest rms distance of bodies, over the surface's diagonal, (0, 1]
  /// Least share of the area within a cell edge of a rib, [0, 1].
  double covered_tolerance = usual_covered_share;
};

/// Returns the default specification of n ribs without clearance. Cells leave room for one cell between two ribs and
/// are at most 1/25 of the surface's diagonal when folded. @param ribs >= 1
optim::RibsSpec usual_ribs(const targets::RibbedSurface& surface, int ribs);

/// Reads the target. @param root a target of kind surface that has `ribs`
/// @throws InvalidInput for whatever formats.md does not allow
RibsFile read_ribs_file(const targets::Node& root);

/// Makes the goal: layout, fit of all tilts and theta, the same ribs loose for comparison, and the simulation.
std::unique_ptr<Goal> make_goal(RibsFile file);

}  // namespace kinetix::app
