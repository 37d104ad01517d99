#pragma once

#include <vector>

#include "model/sheet/sheet.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::targets {

/// Level of each cell that the picture has one for: of all cells of a panel of squares; of another lattice, of
/// those that it is drawn by, which come before the cells of a closed rim and those between.
/// @pre the panel has the goal's columns and rows
std::vector<double> levels_of(const DisplayGoal& goal, const model::Sheet& panel);

}  // namespace kinetix::targets
