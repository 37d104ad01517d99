#pragma once

#include "targets/document/section.hpp"
#include "targets/surface/ribbed_surface.hpp"

namespace kinetix::targets {

/// Keys of a `target:` section that say what the surface is: `mesh` with `units`, or `shape` with its sizes.
std::vector<Key> surface_keys();

/// @throws InvalidInput at the key at fault: for neither or both of mesh and shape, sizes that another shape has, and
/// what read_mesh, mesh_patch and the shapes refuse
SurfacePatch read_surface(const Section& target);

/// "mesh", or the name of the shape.
std::string surface_name(const Section& target);

/// The same for ribs: a mesh may be closed, have holes, and turn as it likes.
/// @throws InvalidInput at the key at fault: also for a mesh whose box is not 20 mm to 5 m large
RibbedSurface read_ribbed_surface(const Section& target);

}  // namespace kinetix::targets
