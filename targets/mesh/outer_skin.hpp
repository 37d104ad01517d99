#pragma once

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// What of a mesh is seen from outside, each triangle once and all wound outward, so that a winding number
/// tells inside from outside. Triangles that share an edge with one other only are turned alike; each patch
/// of them is turned to the side from which more rays leave the mesh (Takayama et al. 2014). Patches that no
/// ray leaves, such as inner shells, triangles listed twice and those without area are left out; the order of
/// the rest is kept. A mesh of which nothing else is left stays as it is.
/// @param mesh with equal vertices joined (triangle_mesh.hpp)
TriangleMesh outer_skin(const TriangleMesh& mesh);

}  // namespace kinetix::targets
