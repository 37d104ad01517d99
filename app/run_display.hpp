#pragma once

#include "app/display_file.hpp"
#include "app/run_curve.hpp"

namespace kinetix {

/// Search for the panel that shows the goal, its balance from flat, and the physics run of its compression.
/// @throws InvalidInput for a panel whose walls overlap, and for one that the machine's memory does not hold
Run run_display(const DisplayFile& file, const RunOptions& options);

}  // namespace kinetix
