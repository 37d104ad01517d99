#pragma once

#include <vector>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Columns (axis x) or rows (axis y) of walls, counted from 0 at the lattice's origin.
int line_count(const Structure& structure, Axis axis);
/// The one of these that a wall is on.
int line_of(const Wall& wall);
/// Hinges of the x-walls of column `line`, or of the y-walls of row `line`; ascending.
std::vector<int> hinges_on_line(const Structure& structure, Axis axis, int line);
/// Whether a wall's lower vertex is of class B: its t is then 1 less the fraction of class A.
bool starts_in_class_b(const Wall& wall);

/// Bodies of each column of vertices that has some, both ascending.
std::vector<std::vector<int>> body_columns(const Structure& structure);

}  // namespace kinetix::model
