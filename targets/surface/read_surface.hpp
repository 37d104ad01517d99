#pragma once

#include "targets/document/section.hpp"
#include "targets/surface/ribbed_surface.hpp"

namespace kinetix::targets {

/// Returns the keys of a `target:` section that describe the surface: `mesh` with `units`, or `shape` with its sizes.
std::vector<Key> surface_keys();

/// @throws InvalidInput at the key at fault: for neither or both of mesh and shape, sizes that another shape has, and
/// what read_mesh, mesh_patch and the shapes refuse
SurfacePatch read_surface(const Section& target);

/// Returns "mesh", or the name of the shape.
std::string surface_name(const Section& target);

/// Reads a surface for ribs. Its mesh may be closed, have holes, and turn by any angle.
/// @throws InvalidInput at the key at fault: also for a mesh whose box is not 20 mm to 5 m large
RibbedSurface read_ribbed_surface(const Section& target);

}  // namespace kinetix::targets
