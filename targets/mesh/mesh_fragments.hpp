#pragma once

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// The mesh without what floats beside it: parts that are farther than about `gap` mm from all others and
/// have less than a tenth of the area of the largest. Vertices are told to be near by bins of that size, so
/// that cracks between triangles do not part a mesh. @pre gap > 0
TriangleMesh without_fragments(const TriangleMesh& mesh, double gap);

}  // namespace kinetix::targets
