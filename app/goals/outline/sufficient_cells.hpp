#pragma once

#include <string>

#include "app/goals/outline/outline_search.hpp"

namespace kinetix::app {

/// Searches panels with more cells, and then of other lattices, until one meets the goal. Panels with a whole rectangle
/// of cells are also cut to the outline. The search ends after a number of walls, which takes about a minute.
/// @param missed design of the file, which misses the goal
/// @return keys of the file with which the goal is met, in YAML: "structure: {cells: [24, 24]}". Empty if none is found
std::string find_sufficient_cells(const OutlineFile& file, const optim::OutlineDesign& missed,
                                  const RunOptions& options);

}  // namespace kinetix::app
