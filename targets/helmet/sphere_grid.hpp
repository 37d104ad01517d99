#pragma once

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// The unit sphere by an icosahedron whose triangles are cut into four `levels` times: 10 * 4^levels + 2
/// vertices, mirrored in x, y and z, wound outward.
TriangleMesh sphere_grid(int levels);

}  // namespace kinetix::targets
