#pragma once

#include "app/goals/fold/fold_goal.hpp"
#include "app/run/goal.hpp"

namespace kinetix::app {

/// Loads of a fold with and without limits, for FoldOutcome.
struct KeptLoads {
  std::optional<FoldLoads> loads, unlimited;
};

/// Reduces theta, with steeper tilts, until drive and hinges stay within the file's limits and the sheet still folds
/// into its goal. Returns the loads of this design and those without limits.
///
/// The design stays as it was if no theta works, or after a stop. Loads are empty if the stop comes before the first
/// design is followed to its equilibrium.
/// @param asked_of settings of the file that apply to any design   @param goal of the file
/// @param search finds the design for a largest theta, rad
KeptLoads keep_limits(const FoldFile& file, const Found& asked_of, const Goal& goal,
                      optim::FoldDesign& design, const std::function<optim::FoldDesign(double)>& search,
                      const RunOptions& options);

}  // namespace kinetix::app
