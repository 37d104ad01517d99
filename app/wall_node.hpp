#pragma once

#include "model/structure.hpp"
#include "targets/document.hpp"

namespace kinetix {

/// A vertex [i, j], of the structure or not.
Vertex read_vertex(const Node& node);

/// Index of the hinge on the wall that `owner` names by its key `wall`.
/// @throws InvalidInput for a wall that the structure does not have, or that does not run from its lower to
/// its upper vertex
int read_hinge_index(const Node& owner, const Structure& structure);

}  // namespace kinetix
