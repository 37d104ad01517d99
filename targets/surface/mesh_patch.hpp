#pragma once

#include "targets/mesh/triangle_mesh.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::targets {

/// An open mesh as heights over its own plane: the mean of its normals is z, the side of the least rectangle round it x,
/// the middle of that rectangle the origin. Heights are one smooth polynomial through its vertices. The rectangle is
/// shrunk to the area that the mesh has, so that round ones are not asked for where they are not.
/// @throws InvalidInput for a mesh that is closed, has holes or several pieces, edges of more than two triangles, that
/// turns by 80 deg or more from its mean normal, covers itself, or is not smooth (the polynomial misses it)
SurfacePatch mesh_patch(const TriangleMesh& mesh);

}  // namespace kinetix::targets
