#pragma once

#include <vector>

#include "model/lattice/square/structure.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::targets {

/// The level of each of the panel's cells, [0, 1]. @pre the panel has the goal's columns and rows of cells
std::vector<double> levels_of(const DisplayGoal& goal, const model::Structure& panel);

}  // namespace kinetix::targets
