#pragma once

#include "app/files/goal_settings.hpp"
#include "app/files/lattice_section.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::app {

/// Columns and rows of a panel whose file gives none.
inline constexpr int usual_side = 12;

/// Content of a target.yaml of kind outline, with defaults filled in. Angles in radians, lengths in mm. Required are
/// `kinetix: 1` and a `target`.
///
///     target: {kind: outline, points: disc.csv, flat: square.csv}
///     structure: {lattice: square, cells: [12, 12], trim: none, cell_mm: 10}
///     variables: {offset_mm: 0.8, t: {range: [0.12, 0.88]}, theta: {range_deg: [20, 40]}}
///     tolerance: {shape: 0.015, iou: 0.95, verify: 0.02}
struct OutlineFile : GoalSettings {
  targets::Outline folded{{{0, 0}, {1, 0}, {0, 1}}};  ///< target.points
  std::optional<targets::Outline> flat = {};          ///< target.flat
  LatticeChoice lattice = {};                    ///< structure.lattice, angle_deg, rim (closed by default)
  int columns = usual_side, rows = usual_side;   ///< structure.cells: the panel before it is trimmed; >= 1
  bool trims = true;                             ///< structure.trim: the flat panel is cut to the outline
  std::optional<double> cell_mm = {};            ///< nullopt: the panel gets the size of the outline
  std::optional<double> thickness_mm = {};       ///< structure.wall_mm
  std::optional<double> height_mm = {};          ///< structure.wall_mm
  std::optional<double> offset_mm = {};          ///< variables.offset_mm; nullopt: 0.08 cells
  std::array<double, 2> t = {0.12, 0.88};        ///< variables.t.range, fractions of a wall
  std::array<double, 2> theta = {0.35, 0.6981};  ///< variables.theta.range_deg, rad, within (0, 45) deg
  double shape_tolerance = 0.015;  ///< rms error of boundary vertices, over the outline's diagonal, (0, 1]
  double iou_tolerance = 0.95;     ///< least intersection over union, (0, 1]

  /// Returns the size of cells and walls for this cell edge, mm.
  model::CellSize size(double edge_mm) const;
  /// Returns the largest offset in cell edges, for this cell edge in mm.
  double offset(double edge_mm) const;
};

/// Returns all keys of a target.yaml of kind outline.
const targets::KeyTable& outline_keys();

/// Reads the target. @param root a target whose kind is outline
/// @throws InvalidInput for whatever formats.md does not allow
OutlineFile read_outline_file(const targets::Node& root);

/// Makes the goal of a panel whose boundary takes a shape when it is pressed: search, closed form and simulation.
std::unique_ptr<Goal> make_goal(OutlineFile file);

}  // namespace kinetix::app
