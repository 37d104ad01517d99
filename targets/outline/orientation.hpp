#pragma once

#include <optional>

#include "targets/outline/outline.hpp"

namespace kinetix::targets {

/// Returns the direction of the area within an outline, rad, which turns with it. The first of the moments integral (z
/// - middle)^n dA, n = 2 to 6, that does not vanish gives n directions, with z = x + i y. The result is the one
/// towards which most of the area lies far out (integral of |z - middle|^2 (z - middle) dA). Ties go to the direction
/// nearest to the outline's first point. Empty for a disc, whose directions are all equal.
std::optional<double> direction_of(const Outline& outline);

/// Returns the smaller diagonal of two bounding boxes, mm: square to direction_of, and at 45 deg to it. It does not
/// depend on how the outline is turned. A disc gives the diagonal of the axis-aligned box.
double smallest_diagonal(const Outline& outline);

/// Returns the outline turned about the origin. @param angle rad, counter-clockwise; 0 leaves it as it is
Outline turned(const Outline& outline, double angle);

}  // namespace kinetix::targets
