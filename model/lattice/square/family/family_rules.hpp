#pragma once

#include "model/linkage/axis.hpp"

namespace kinetix::model {

/// Exact families of square lattices (kinematics.md section 2), and `planar`: upright hinges that close every face of
/// the sheet as on any planar graph (section 5).
enum class Family { F1, F2, F3, F4, planar, none };

/// Rule on offsets that F1 to F4 share, as a sentence.
inline constexpr const char* off_the_wall =
    "hinges off the middle of their walls (offset) need upright hinges";

/// Tests one wall against the rules of the sheet families F1, F2 and F3 (folding along x). Returns the rule that its
/// fraction and tilt break, as a sentence, or nullptr. It does not check if the walls of a column or a row agree.
/// @param t, beta of the wall, in either direction   @param tolerance on the fraction (absolute) and the tilt (rad)
const char* broken_rule(Family family, Axis axis, double t, double beta, double tolerance);

}  // namespace kinetix::model
