#pragma once

#include "app/goals/curve/curve_file.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "optim/curve/fit_curve.hpp"

namespace kinetix::app {

/// A strip that was tried for how its prints come out.
struct CurveCandidate {
  int columns = 0;
  double cell_mm = 0;
  double theta = 0;         ///< rad
  double shape_rms = 0;     ///< of the design, over the goal's diagonal
  double as_made_mm = 0;    ///< rms that prints are expected to be off; NaN where that is not known
  double as_made_p95 = 0;   ///< mm, what 95 of 100 keep
  bool is_allowed = false;  ///< meets the goal, with no wall in the way, and can be printed
};

/// Strips from which a robust search chooses.
struct RobustCurve {
  optim::FreeCurveDesign found;       ///< the one chosen
  model::CellSize size;               ///< of its cells
  HingeSection hinge;                 ///< of its walls
  std::vector<CurveCandidate> tried;  ///< first the plain search's
  std::size_t chosen = 0;             ///< in tried
};

/// The strip whose prints come nearest to the curve, to first order, among those whose design meets it: over theta,
/// and over numbers of columns and sizes of cells where the file leaves them open.
/// @param plain what a search for the least error of the design found
RobustCurve robust_curve(const CurveFile& file, const optim::FreeCurveDesign& plain,
                         const optim::MultiStartOptions& search, const RunOptions& options);

}  // namespace kinetix::app
