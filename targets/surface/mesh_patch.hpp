#pragma once

#include "targets/mesh/triangle_mesh.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::targets {

/// Fits an open mesh by heights over its mean plane. The mean of its normals is z, the side of the least rectangle
/// round it x, and the middle of that rectangle the origin. Heights are one smooth polynomial through its vertices.
/// The rectangle is shrunk to the area of the mesh, so that round meshes are not evaluated outside their boundary.
/// @throws InvalidInput for a mesh that is closed, covers itself, has holes, several pieces or edges of more than two
/// triangles. It also throws for a mesh that turns by 80 deg or more from its mean normal, or is not smooth (the
/// polynomial misses it).
SurfacePatch mesh_patch(const TriangleMesh& mesh);

}  // namespace kinetix::targets
