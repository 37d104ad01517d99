#pragma once

#include "targets/curve/space_curve.hpp"
#include "targets/document/section.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "targets/mesh/triangle_tree.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::targets {

/// Surface, open or closed, and the line over it that a spine follows, mm, in the frame of the ribs. The spine lies in
/// the plane x = 0 and starts at its end of least y; both ends are at z = 0.
struct RibbedSurface {
  MeshDistance surface;
  SpaceCurve spine;
  Eigen::Isometry3d to_given;  ///< frame of the ribs to that of the mesh, mm
  double area = 0;             ///< of all triangles, mm^2
  double diagonal = 0;         ///< of the box of the mesh as it was given, mm
};

/// Makes a spine along the longest axis of the mesh, in the middle across. On an open mesh that has a side, it runs
/// from boundary to boundary, seen from that side. On any other mesh it runs from end to end.
/// @throws InvalidInput for a mesh without area, or that its middle plane does not cut
RibbedSurface ribbed_surface(const TriangleMesh& mesh);

/// Makes a spine over a patch, along the longer side of its rectangle; ties go to x.
RibbedSurface ribbed_surface(const SurfacePatch& patch);

/// Makes a spine of a mesh along x, in the middle across. @param has_side whether it is an open surface that is seen
/// from +z
RibbedSurface ribbed_along_x(const TriangleMesh& mesh, bool has_side);

/// Returns the patch as triangles over its rectangle, mm.
TriangleMesh patch_mesh(const SurfacePatch& patch);

/// Returns the section of a mesh by a plane through a point of it, from that point in both directions. Each part ends
/// at the boundary, or half way round a closed section. The first goes to smaller x.
/// @param p on the mesh, mm.   @param normal of the plane, not along x.   @throws InvalidInput if the plane does not
/// cut the mesh
std::array<std::vector<Eigen::Vector3d>, 2> section_from(const TriangleMesh& mesh, const Eigen::Vector3d& p,
                                                         const Eigen::Vector3d& normal);

/// Returns the keys of a `target:` section that describe the surface: `mesh` with `units`, or `shape` with its sizes.
std::vector<Key> surface_keys();

/// @throws InvalidInput at the key at fault: for neither or both of mesh and shape, sizes that another shape has, and
/// what read_mesh, mesh_patch and the shapes refuse. Triangles of a mesh may be wound either way (wound_alike).
SurfacePatch read_surface(const Section& target, const MeshReader& read = read_plain_mesh);

/// Returns "mesh", or the name of the shape.
std::string surface_name(const Section& target);

/// Reads a surface for ribs. Its mesh may be closed, have holes, and turn by any angle.
/// @throws InvalidInput at the key at fault: also for a mesh whose box is not 20 mm to 5 m large
RibbedSurface read_ribbed_surface(const Section& target, const MeshReader& read = read_plain_mesh);

}  // namespace kinetix::targets
