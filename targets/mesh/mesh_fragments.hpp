#pragma once

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Returns the mesh without parts that float next to it: those farther than about `gap` mm from all others, with less
/// than a tenth of the area of the largest. Vertices in the same or in adjacent bins of that size count as near, so
/// cracks between triangles do not split a mesh. @pre gap > 0
TriangleMesh without_fragments(const TriangleMesh& mesh, double gap);

}  // namespace kinetix::targets
