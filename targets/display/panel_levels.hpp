#pragma once

#include <vector>

#include "model/lattice/lattice.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::targets {

/// Returns the levels of the panel's cells that have a place in the picture. On a panel of squares these are all
/// cells. On another lattice they are the cells by which it is drawn, which precede those of a closed boundary and
/// those between.
/// @pre the panel has the goal's columns and rows
std::vector<double> levels_of(const DisplayGoal& goal, const model::Lattice& panel);

/// Returns one value per cell of the picture, in the order of DisplayGoal::levels.
/// @param values of the panel's cells, as many as levels_of() gives and in that order
std::vector<double> in_order_of_goal(const DisplayGoal& goal, const model::Lattice& panel,
                                     const std::vector<double>& values);

}  // namespace kinetix::targets
