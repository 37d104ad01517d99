#pragma once

#include <functional>

#include "app/goals/curve/curve_file.hpp"
#include "app/run/found.hpp"
#include "app/run/robust_choice.hpp"
#include "app/run/run_options.hpp"
#include "optim/curve/fit_curve.hpp"

namespace kinetix::app {

/// A strip that was tried for how its prints come out.
struct CurveCandidate {
  int columns = 0;
  double cell_mm = 0;
  std::optional<double> gap_mm = {};  ///< of blocks and films
  double theta = 0;                   ///< rad
  double shape_rms = 0;               ///< of the design, over the goal's diagonal
  double designed_mm = 0;  ///< the same in mm; in_matter: rms of its points, as RobustCandidate has it
  double as_made_mm = 0;   ///< rms that prints are expected to be off; NaN where that is not known
  double as_made_p95 = 0;  ///< mm, what 95 of 100 keep
  bool is_allowed =
      false;  ///< meets the goal, with no wall in the way, can be printed, and its hinges bear it
  bool in_matter = false;  ///< the last four with what makes up for elastic hinges, not by the closed form
};

/// Strips from which a robust search chooses.
struct RobustCurve {
  optim::FreeCurveDesign found;        ///< the one chosen
  model::CellSize size;                ///< of its cells
  HingeSection hinge;                  ///< of its walls
  std::vector<HingePart> hinge_parts;  ///< likewise, those made otherwise
  std::vector<CurveCandidate> tried;   ///< first the plain search's
  std::size_t chosen = 0;              ///< in tried
};

/// Strips whose elastic hinges are made up for, which takes about a second each: their closed forms rank the others.
inline constexpr std::size_t robust_finalists = 6;

/// A strip that was found for a file, for the pipeline.
using StripOf = std::function<Found(const CurveFile&, const optim::FreeCurveDesign&)>;

/// What a strip comes to once its elastic hinges are made up for.
using StripJudge = std::function<RobustCandidate(const CurveFile&, const optim::FreeCurveDesign&)>;

/// The strip with the least robust_cost(), prints to first order, among those whose design meets the curve: over theta,
/// over numbers of columns and sizes of cells where the file leaves them open, and over gaps of blocks and films. Where hinges
/// are elastic the best half dozen of their closed forms, the plain one among them, are judged once more as the run would leave
/// them, and the choice is among these.
/// @pre file.robust   @param plain what a search for the least error of the design found
RobustCurve robust_curve(const CurveFile& file, const optim::FreeCurveDesign& plain,
                         const optim::MultiStartOptions& search, const RunOptions& options,
                         const StripOf& strip_of, const StripJudge& judge);

}  // namespace kinetix::app
