#pragma once

#include "model/lattice/square/structure.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

targets::ValueType vertex_type();
/// The key `wall`. @param with the alternative that it goes with
targets::Key wall_key(std::string with = {});

/// A vertex [i, j], of the structure or not.
model::Vertex read_vertex(const targets::Node& node);

/// Index of the hinge on the wall that `owner` names by its key `wall`.
/// @throws InvalidInput for a wall that the structure does not have, or that does not run from its lower to
/// its upper vertex
int read_hinge_index(const targets::Section& owner, const model::Structure& structure);

}  // namespace kinetix::app
