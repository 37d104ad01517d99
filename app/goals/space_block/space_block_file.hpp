#pragma once

#include "app/files/goal_settings.hpp"
#include "app/files/structure_section.hpp"
#include "optim/space_block/fit_space_block.hpp"

namespace kinetix::app {

/// Content of a target.yaml of kind space_block, with defaults filled in. Angles in radians, lengths in mm. Required
/// are `kinetix: 1` and a `target`.
///
///     target: {kind: space_block, factor: [0.82, 0.86, 0.88], size_mm: [120, 120, 60]}
///     structure: {cells: [2, 2, 1], cell_mm: 20, wall_mm: {thickness: 1.6, height: 3}}
///     variables: {theta: {range_deg: [5, 44]}, gusset: {range: [0.1, 0.8]}}
///     tolerance: {factor: 0.005, size: 0.05, verify: 0.02}
struct SpaceBlockFile : GoalSettings {
  targets::SpaceBlockGoal goal;
  optim::SpaceBlockVariables variables = {};
  ThinWalls walls = {};             ///< structure.wall_mm
  double factor_tolerance = 0.005;  ///< largest error of a direction's factor, (0, 1]
  double size_tolerance = 0.05;     ///< largest relative error of a length at rest, (0, 1]

  optim::SpaceBlockDesign found;  ///< closed-form design, computed while the file is read

  model::CellSize size() const { return walls.size(found.edge_mm); }
};

/// Returns all keys of a target.yaml of kind space_block.
const targets::KeyTable& space_block_keys();

/// Reads the target. @param root a target whose kind is space_block
/// @throws InvalidInput for whatever formats.md does not allow, and for a factor out of reach
SpaceBlockFile read_space_block_file(const targets::Node& root);

/// Makes the goal: the lattice, its closed form, and the simulation between plates.
std::unique_ptr<Goal> make_goal(SpaceBlockFile file);

}  // namespace kinetix::app
