#pragma once

#include <vector>

#include "model/lattice/lattice.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::targets {

/// Level of each cell that the picture has one for: of all cells of a panel of squares; of another lattice, of
/// those that it is drawn by, which come before the cells of a closed rim and those between.
/// @pre the panel has the goal's columns and rows
std::vector<double> levels_of(const DisplayGoal& goal, const model::Lattice& panel);

/// The other way: one value per cell of the picture, in the order of DisplayGoal::levels.
/// @param values of the panel's cells, as many as levels_of() gives
std::vector<double> in_order_of_goal(const DisplayGoal& goal, const model::Lattice& panel,
                                     const std::vector<double>& values);

}  // namespace kinetix::targets
