#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/files/goal_settings.hpp"
#include "app/files/hinge_parts.hpp"
#include "app/files/lattice_section.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "optim/display/display_problem.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::app {

/// Turn of a hinge, rad, where plates have come closer by `compression`, (0, 0.5], between straight rows: 2 theta.
double turn_of_compression(double compression);

/// A target.yaml of kind display, as asked for or by default. `kinetix: 1` and a `target` are enough.
///
///     target: {kind: display, glyph: T, channel: light}         # or image, or rows: read_display.hpp
///     drive: {axis: y, compression: 0.12}                       # of the plates, or
///     drive: {kind: hinge, angle_deg: 70}                       # of a hinge, all rows free
///     variables:
///       offset_mm: 0.8                                          # of hinges across their walls
///       stretch_mm: 0.05                                        # of hinges, on purpose
///       t: {range: [0.2, 0.8], corner_mm: 1, symmetry: none}
///       compression: {range: [0.05, 0.2]}                       # searched for, from drive.compression
///       axis: [x, y]                                            # each is tried, the best taken
///     tolerance: {stretch: 0.12, auc: 0.97, contrast: 3, verify: 0.05}
///
/// `hinge` is elastic, `solver` mma, ccsa or slsqp, its starts for each axis.
struct DisplayFile : GoalSettings {
  DisplayFile() { verify_tolerance = usual_verify; }

  targets::DisplayGoal goal;
  optim::Channel channel = optim::Channel::light;
  model::CellSize size = {};   ///< structure.cell_mm (default 10), structure.wall_mm
  LatticeChoice lattice = {};  ///< structure.lattice, angle_deg, rim; others than squares with offsets alone
  bool by_hinge = false;       ///< drive.kind: one hinge is turned, in place of plates that close in
  std::vector<model::Axis> axes = {
      model::Axis::y};  ///< drive.axis or variables.axis: normals of the plates to try
  /// drive.compression: fraction by which the plates come closer, (0, 0.5], within the range if there is one
  double compression = 0.185;
  /// drive.angle_deg: turn of the driven hinge to whichever side shows the picture, rad, (0, 2 pi / 3]
  double angle = turn_of_compression(0.185);
  std::optional<int> driven_hinge =
      {};              ///< drive.wall: the driven one; nothing: one in the middle (middle_hinge)
  bool press = false;  ///< drive.press: plates that push and do not hold
  /// variables.compression.range, within (0, 0.5], likewise a fraction of the first distance
  std::optional<std::array<double, 2>> compression_range = {};
  /// variables.t.range, fractions of a wall, (0, 1), no nearer to a corner than corner_mm
  std::array<double, 2> t = {0.2, 0.8};
  /// variables.offset_mm over cell_mm: largest of a hinge across its wall, cell edges, [0, 0.5). 0: hinges on
  /// their walls, which have to stretch.
  double offset = 0.08;
  /// variables.stretch_mm over cell_mm: most that hinges with offsets may stretch on purpose, cell edges, [0, 0.5).
  double strain = 0;
  optim::Symmetry symmetry = optim::Symmetry::none;  ///< variables.t.symmetry
  double stretch = 0.12;  ///< tolerance.stretch: most of a hinge, cell edges, (0, 1]
  double auc = 0.97;      ///< tolerance.auc: least, (0.5, 1]; rank correlation for grey goals
  double contrast = 3;    ///< tolerance.contrast: least d', dimensionless, of goals with two levels, >= 0
  HingeLimits limits = {};
  static constexpr double usual_verify = 0.05;  ///< tolerance.verify, cell edges: panels strain
};

// Defaults of searches with hinges on their walls, as the paper's displays are: local texture, which is read
// cell by cell.
inline constexpr optim::Channel channel_on_walls = optim::Channel::aperture;
// Fraction of the plates' distance: where a letter's cells differ most before walls meet.
inline constexpr double compression_on_walls = 0.12;
// Fractions of a wall: beyond, the shorter half is no longer than a wall is thick.
inline constexpr std::array<double, 2> t_on_walls = {0.08, 0.92};

/// Every key of a target.yaml of kind display.
const targets::KeyTable& display_keys();

/// @param root a target whose kind is display
/// @throws InvalidInput for whatever formats.md does not allow
DisplayFile read_display_file(const targets::Node& root);

/// Makes the goal: the search, the panel's equilibrium from flat, and the physics run of its compression. Its search throws
/// InvalidInput for a panel whose walls overlap, and for one that the machine's memory does not hold.
std::unique_ptr<Goal> make_goal(DisplayFile file);

}  // namespace kinetix::app
