#pragma once

#include <vector>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Returns the number of columns (axis x) or rows (axis y) of walls, counted from 0 at the lattice's origin.
int line_count(const Structure& structure, Axis axis);
/// Returns the column or row of a wall.
int line_of(const Wall& wall);
/// Returns the hinges of the x-walls of column `line`, or of the y-walls of row `line`; ascending.
std::vector<int> hinges_on_line(const Structure& structure, Axis axis, int line);
/// Returns true if a wall's lower vertex is of sublattice B: its t is then 1 minus the fraction of sublattice A.
bool starts_in_class_b(const Wall& wall);

/// Returns the bodies of each column of vertices with bodies, both ascending.
std::vector<std::vector<int>> body_columns(const Structure& structure);

}  // namespace kinetix::model
