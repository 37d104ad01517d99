#pragma once

#include <optional>

#include "targets/outline/outline.hpp"

namespace kinetix::targets {

/// The direction of the area within an outline, rad, which turns with it: from the first of the moments
/// integral (z - middle)^n dA, n = 2 to 6, that does not vanish, z = x + i y; of its n directions the one towards which most of the
/// area lies far out (integral of |z - middle|^2 (z - middle) dA), or where they are alike the one nearest to its first point. Nothing for a disc, whose directions are all alike.
std::optional<double> direction_of(const Outline& outline);

/// The smaller diagonal of two bounding boxes, mm: square to its direction, and at 45 deg to it. It does not depend on how the
/// outline is turned. Of a disc, that of the axis-aligned box.
double smallest_diagonal(const Outline& outline);

/// The same outline, turned about the origin. @param angle rad, counter-clockwise; 0 leaves it as it is
Outline turned(const Outline& outline, double angle);

}  // namespace kinetix::targets
