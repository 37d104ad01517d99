#pragma once

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Returns the triangles that are visible from outside, each once and all wound outward, so that a winding number
/// separates inside from outside. Triangles that share an edge with only one other are turned consistently. Each patch
/// of them is turned to the side from which more rays leave the mesh (Takayama et al. 2014). Patches that no ray
/// leaves, such as inner shells, are left out, as are triangles listed twice or without area. The order of the rest is
/// kept. A mesh of which nothing else is left stays as it is.
/// @param mesh with equal vertices joined (triangle_mesh.hpp)
TriangleMesh outer_skin(const TriangleMesh& mesh);

}  // namespace kinetix::targets
