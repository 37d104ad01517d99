#pragma once

#include "app/fold_file.hpp"
#include "app/run_curve.hpp"

namespace kinetix {

/// Search for the net that folds to the goal, its closed form, and the physics run of its folding.
/// @throws InvalidInput for walls that close before the range of theta
Run run_fold(const FoldFile& file, const RunOptions& options);

}  // namespace kinetix
