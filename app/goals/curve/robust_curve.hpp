#pragma once

#include <functional>
#include <utility>

#include "app/goals/curve/curve_file.hpp"
#include "app/run/goal.hpp"
#include "app/run/robust_choice.hpp"
#include "optim/curve/fit_curve.hpp"

namespace kinetix::app {

/// Candidate strip of a robust search.
struct CurveCandidate : RobustCandidate {
  int columns = 0;
  double shape_rms = 0;    ///< shape error of the design, over the goal's diagonal
  bool in_matter = false;  ///< measured with elastic hinges and compensated, not by the closed form
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
/// @param found_for converts a strip to the input of the pipeline
std::pair<CurveStrip, RobustCurve> robust_curve(const Goal& goal, CurveStrip plain,
                                                const optim::MultiStartOptions& search,
                                                const RunOptions& options,
                                                const std::function<Found(const CurveStrip&)>& found_for);

}  // namespace kinetix::app
