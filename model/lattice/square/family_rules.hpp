#pragma once

#include "model/linkage/axis.hpp"

namespace kinetix::model {

/// The exact families of square lattices (kinematics.md section 2).
enum class Family { F1, F2, F3, F4, none };

/// The rules of the sheet families F1, F2 and F3 (folding along x) for one wall: which of them its fraction
/// and tilt break, as a sentence; nullptr where they keep all. Whether the walls of a column or a row
/// agree is not checked.
/// @param t, beta of the wall, either way round   @param tolerance on the fraction (absolute) and the tilt
/// (rad)
const char* broken_rule(Family family, Axis axis, double t, double beta, double tolerance);

}  // namespace kinetix::model
