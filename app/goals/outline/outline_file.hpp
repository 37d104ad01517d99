#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/files/goal_settings.hpp"
#include "app/files/lattice_section.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::app {

/// A target.yaml of kind outline, as asked for or by default. Angles in radians, lengths in mm. `kinetix: 1` and a
/// `target` are enough.
///
///     target: {kind: outline, points: disc.csv, flat: square.csv}
///     structure: {lattice: square, cells: [12, 12], trim: none, cell_mm: 10}
///     variables: {offset_mm: 0.8, t: {range: [0.12, 0.88]}, theta: {range_deg: [20, 40]}}
///     tolerance: {shape: 0.015, iou: 0.95, verify: 0.02}
struct OutlineFile : GoalSettings {
  targets::Outline folded{{{0, 0}, {1, 0}, {0, 1}}};  ///< target.points
  std::optional<targets::Outline> flat = {};          ///< target.flat
  LatticeChoice lattice = {};               ///< structure.lattice, angle_deg, rim (closed by default)
  int columns = 12, rows = 12;              ///< structure.cells, or of the rectangle that is trimmed; >= 1
  bool trims = true;                        ///< structure.trim: cut to the outline when flat
  std::optional<double> cell_mm = {};       ///< nothing: the panel gets the outline's own size
  std::optional<double> thickness_mm = {};  ///< structure.wall_mm
  std::optional<double> height_mm = {};     ///< likewise
  std::optional<double> offset_mm = {};     ///< variables.offset_mm; nothing: 0.08 cells
  std::array<double, 2> t = {0.12, 0.88};   ///< variables.t.range, fractions of a wall
  std::array<double, 2> theta = {0.35, 0.6981};  ///< variables.theta.range_deg, rad, within (0, 45) deg
  double shape_tolerance = 0.015;  ///< of the rim's vertices, over the outline's diagonal, (0, 1]
  double iou_tolerance = 0.95;     ///< least intersection over union, (0, 1]

  /// The panel's size where a cell edge has this length, mm.
  model::CellSize size(double edge_mm) const;
  /// Largest offset over this edge, cell edges.
  double offset(double edge_mm) const;
};

/// Every key of a target.yaml of kind outline.
const targets::KeyTable& outline_keys();

/// @param root a target whose kind is outline
/// @throws InvalidInput for whatever formats.md does not allow
OutlineFile read_outline_file(const targets::Node& root);

/// Makes the goal of a panel whose rim takes a shape when it is pressed: the search, the closed form, and the physics run.
std::unique_ptr<Goal> make_goal(OutlineFile file);

}  // namespace kinetix::app
