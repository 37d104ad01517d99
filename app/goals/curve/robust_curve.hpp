#pragma once

#include <functional>
#include <utility>

#include "app/goals/curve/curve_file.hpp"
#include "app/run/goal.hpp"
#include "app/run/robust_choice.hpp"
#include "optim/curve/fit_curve.hpp"

namespace kinetix::app {

/// A strip that was tried for how its prints come out.
struct CurveCandidate : RobustCandidate {
  int columns = 0;
  double shape_rms = 0;    ///< of the design, over the goal's diagonal
  bool in_matter = false;  ///< with what makes up for elastic hinges, not by the closed form
};

/// Strips from which a robust search chose.
struct RobustCurve {
  std::vector<CurveCandidate> tried;  ///< first the plain search's
  std::size_t chosen = 0;             ///< in tried
};

/// A strip that was found, with the cells and hinges of its file.
struct CurveStrip {
  CurveFile file;
  optim::FreeCurveDesign found;
  CurveCandidate candidate = {};
};

/// Returns the variables of a search for the file's curve.
optim::CurveVariables curve_variables(const CurveFile& file);

/// Strips whose elastic hinges are made up for, which takes about a second each: their closed forms rank the others.
inline constexpr std::size_t robust_finalists = 6;

/// Returns the strip with the least robust_cost(), prints to first order, among those whose design meets the curve: over theta,
/// over numbers of columns and sizes of cells where the file leaves them open, and over gaps of blocks and films. Where hinges
/// are elastic the best half dozen of their closed forms, the plain one among them, are judged once more as the run would leave
/// them, and the choice is among these.
/// @pre plain.file.robust   @param plain what a search for the least error of the design found
/// @param found_for makes of a strip what the pipeline takes
std::pair<CurveStrip, RobustCurve> robust_curve(const Goal& goal, CurveStrip plain,
                                                const optim::MultiStartOptions& search,
                                                const RunOptions& options,
                                                const std::function<Found(const CurveStrip&)>& found_for);

}  // namespace kinetix::app
