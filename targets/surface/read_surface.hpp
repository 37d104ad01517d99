#pragma once

#include "targets/document/section.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::targets {

/// Keys of a `target:` section that say what the surface is: `mesh` with `units`, or `shape` with its sizes.
std::vector<Key> surface_keys();

/// @throws InvalidInput at the key at fault: for neither or both of mesh and shape, sizes that another shape has, and
/// what read_mesh, mesh_patch and the shapes refuse
SurfacePatch read_surface(const Section& target);

}  // namespace kinetix::targets
