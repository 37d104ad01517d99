#pragma once

#include "app/files/goal_settings.hpp"
#include "app/run/goal.hpp"
#include "app/run/search_result.hpp"
#include "model/lattice/square/structure.hpp"
#include "optim/curve/fit_curve.hpp"
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

/// Candidate strip of a robust search.
struct CurveCandidate : RobustCandidate {
  int columns = 0;
  double shape_rms = 0;         ///< shape error of the design, over the goal's diagonal
  bool is_compensated = false;  ///< measured with elastic hinges and compensated, not by the closed form
};

/// All candidates of a robust search and its choice.
struct RobustCurve {
  std::vector<CurveCandidate> tried;  ///< the first is the strip of the plain search
  std::size_t chosen = 0;             ///< index in tried
};

/// Search result, with the cells and hinges of its file.
struct CurveStrip {
  CurveFile file;
  optim::FreeCurveDesign found;
  CurveCandidate candidate = {};
};

/// Returns the variables of a search for the file's curve.
optim::CurveVariables curve_variables(const CurveFile& file);

/// Number of strips that are compensated for elastic hinges, about a second each. The closed form ranks the others.
inline constexpr std::size_t robust_finalists = 6;

/// Returns the strip with the least robust_cost(), prints to first order, among those whose design meets the curve.
///
/// The search varies theta, the number of columns with the cell size if the file leaves them open, and the gaps of
/// elastomer and living hinges. With elastic hinges, robust_finalists strips are compensated and measured again. These
/// are the plain strip and the best by closed form, and the choice is among them.
/// @pre plain.file.robust   @param plain strip with the least error of the design
/// @param make_search_result converts a strip to the input of the pipeline
std::pair<CurveStrip, RobustCurve> robust_curve(
    const Goal& goal, CurveStrip plain, const optim::MultiStartOptions& search, const RunOptions& options,
    const std::function<SearchResult(const CurveStrip&)>& make_search_result);

}  // namespace kinetix::app
