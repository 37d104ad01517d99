#pragma once

#include "app/goals/fold/fold_goal.hpp"
#include "app/run/goal.hpp"

namespace kinetix::app {

/// What a fold bears, as FoldOutcome has it.
struct KeptLoads {
  std::optional<FoldLoads> loads, unlimited;
};

/// Folds at a smaller theta, with steeper tilts, until drive and hinges bear no more than the limits of the file and the sheet
/// still folds into its goal, and keeps what they bore without them. Where no theta will do, the design stays as it was; so it does
/// where the options say stop, of which no loads are known before its own path is through.
/// @param asked_of has what the file asks of any design   @param goal of the file
/// @param search finds the design for a largest theta, rad
KeptLoads keep_limits(const FoldFile& file, const Found& asked_of, const Goal& goal,
                      optim::FoldDesign& design, const std::function<optim::FoldDesign(double)>& search,
                      const RunOptions& options);

}  // namespace kinetix::app
