#pragma once

#include "app/files/goal_settings.hpp"
#include "app/files/hinge_section.hpp"
#include "app/files/lattice_section.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "optim/display/display_problem.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::app {

/// Returns the turn 2 theta (rad) of a hinge between straight rows at this compression, (0, 0.5].
double turn_of_compression(double compression);

/// Content of a target.yaml of kind display, with defaults filled in. Required are `kinetix: 1` and a `target`.
///
/// `target: {kind: display, glyph: T, channel: light}`. Instead of a glyph: image or rows, see read_display.hpp.
/// `drive: {axis: y, compression: 0.12}` for plates, or
/// `drive: {kind: hinge, angle_deg: 70}` for one driven hinge with all rows free.
/// `variables:`
/// - `offset_mm: 0.8`: offset of hinges across their walls.
/// - `stretch_mm: 0.05`: intended stretch of hinges.
/// - `t: {range: [0.2, 0.8], corner_mm: 1, symmetry: none}`
/// - `compression: {range: [0.05, 0.2]}`: search range; the search starts at drive.compression.
/// - `axis: [x, y]`: directions to try; the best is used.
///
/// `tolerance: {stretch: 0.12, auc: 0.97, contrast: 3, verify: 0.05}`.
///
/// `hinge` is elastic. `solver` is mma, ccsa or slsqp, and its starts count per axis.
struct DisplayFile : GoalSettings {
  DisplayFile() { verify_tolerance = default_verify_tolerance; }

  targets::DisplayGoal goal;
  optim::Channel channel = optim::Channel::light;
  model::CellSize size = {};   ///< structure.cell_mm (default 10), structure.wall_mm
  LatticeChoice lattice = {};  ///< structure.lattice, angle_deg, rim; all but squares need offsets
  bool by_hinge = false;       ///< drive.kind: one hinge is driven instead of plates
  std::vector<model::Axis> axes = {
      model::Axis::y};  ///< drive.axis or variables.axis: normals of the plates to try
  /// drive.compression: reduction of the plates' distance as a fraction, (0, 0.5], within compression_range if given.
  /// Further compression brings bodies so near to each other that pins need far larger cells.
  double compression = 0.12;
  /// drive.angle_deg: turn of the driven hinge toward the side that shows the picture, rad, (0, 2 pi / 3]
  double angle = turn_of_compression(0.12);
  std::optional<int> driven_hinge = {};  ///< drive.wall; nullopt: a hinge in the middle (middle_hinge)
  bool press = false;                    ///< drive.press: plates push but do not pull
  /// variables.compression.range, within (0, 0.5], fractions of the initial distance
  std::optional<std::array<double, 2>> compression_range = {};
  /// variables.t.range, fractions of a wall, (0, 1), at least corner_mm from a corner
  std::array<double, 2> t = {0.2, 0.8};
  /// variables.offset_mm over cell_mm: largest offset of a hinge across its wall, cell edges, [0, 0.5). With 0 the
  /// hinges are on their walls and have to stretch.
  double offset = 0.08;
  /// variables.stretch_mm over cell_mm: largest intended stretch of hinges with offsets, cell edges, [0, 0.5)
  double strain = 0;
  optim::Symmetry symmetry = optim::Symmetry::none;  ///< variables.t.symmetry
  double stretch = 0.12;  ///< tolerance.stretch: largest stretch of a hinge, cell edges, (0, 1]
  double auc = 0.97;      ///< tolerance.auc: least value, (0.5, 1]; rank correlation for grey goals
  double contrast = 3;    ///< tolerance.contrast: least d', dimensionless, >= 0, for goals with two levels
  HingeLimits limits = {};
  static constexpr double default_verify_tolerance =
      0.05;  ///< tolerance.verify, cell edges; large because panels strain
};

// Default channel for hinges on their walls, as in the paper's displays: local texture, read cell by cell.
inline constexpr optim::Channel channel_on_walls = optim::Channel::aperture;
// Default range of t for hinges on their walls, fractions of a wall: beyond it the shorter half is no longer than the
// wall is thick.
inline constexpr std::array<double, 2> t_on_walls = {0.08, 0.92};

/// Returns all keys of a target.yaml of kind display.
const targets::KeyTable& display_keys();

/// Reads the target. @param root a target whose kind is display
/// @throws InvalidInput for whatever formats.md does not allow
DisplayFile read_display_file(const targets::Node& root);

/// Makes the goal: the search, the panel's equilibrium from flat, and the simulation of its compression. Its search
/// throws InvalidInput for a panel with overlapping walls, and for one that exceeds the machine's memory.
std::unique_ptr<Goal> make_goal(DisplayFile file);

}  // namespace kinetix::app
