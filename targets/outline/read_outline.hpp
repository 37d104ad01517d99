#pragma once

#include "targets/curve/read_points.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::targets {

/// Returns every key of a `target:` section of kind outline.
const KeyTable& outline_target_keys();

/// Reads the outline under a key (read_points, with the second axis y).
/// @throws InvalidInput at the point at fault, in the CSV or in the document, as read_points, or for what Outline
/// refuses
Outline read_outline(const Node& points);

}  // namespace kinetix::targets
