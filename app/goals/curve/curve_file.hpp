#pragma once

#include <optional>
#include <string>

#include "app/files/goal_settings.hpp"
#include "model/lattice/square/structure.hpp"
#include "targets/curve/curve.hpp"

namespace kinetix::app {

/// Content of a target.yaml of kind curve, with defaults filled in. Angles in radians, lengths in mm.
///
/// Required are `kinetix: 1` and a `target`. The default structure is a strip [40, 1]. It has fewer columns, at least
/// 8, if the process cannot print the walls of 40. The strip has the curve's length at theta = 30 deg:
/// cell_mm = length / (columns cos 30 deg). If only cell_mm is given, this equation gives the number of columns.
/// Walls follow default_size (app/files/structure_section.hpp).
struct CurveFile : GoalSettings {
  explicit CurveFile(targets::Curve goal) : curve(std::move(goal)) {}

  targets::Curve curve;  ///< target.points

  int columns = 40;           ///< structure.cells, >= 2
  int rows = 1;               ///< >= 1
  model::CellSize size = {};  ///< structure.cell_mm, structure.wall_mm

  optim::AngleRange beta = {-60 * radians_per_degree, 60 * radians_per_degree};  ///< within +-89 deg
  optim::Per per = optim::Per::column;                                           ///< column or all
  optim::Symmetry symmetry = optim::Symmetry::none;  ///< rotate_4 only where columns == rows
  optim::AngleRange theta = {2 * radians_per_degree, 44 * radians_per_degree};  ///< within (0, 45) deg

  double shape_tolerance = 0.01;  ///< largest shape_rms, over the curve's bounding-box diagonal, (0, 1]

  bool free_size = false;  ///< no structure.cell_mm: cells follow from the curve's length
  bool free_walls = true;  ///< no structure.wall_mm: walls follow from the cells
};

/// Returns all keys of a target.yaml of kind curve.
const targets::KeyTable& curve_keys();

/// Reads the target. @param root a target whose kind is curve
/// @throws InvalidInput for whatever formats.md does not allow
CurveFile read_curve_file(const targets::Node& root);

/// Makes the goal: the search, the closed form, and the simulation of its folding.
std::unique_ptr<Goal> make_goal(CurveFile file);

}  // namespace kinetix::app
