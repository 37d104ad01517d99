#pragma once

#include <Eigen/Geometry>

#include "targets/curve/space_curve.hpp"
#include "targets/mesh/mesh_distance.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::targets {

/// A surface, open or closed, and the line over it that a spine follows, mm, in the frame of the ribs: the
/// spine in the plane x = 0, from its end of least y, both ends at z = 0.
struct RibbedSurface {
  MeshDistance surface;
  SpaceCurve spine;
  Eigen::Isometry3d to_given;  ///< frame of the ribs to that of the mesh, mm
  double area = 0;             ///< of all triangles, mm^2
  double diagonal = 0;         ///< of the box of the mesh as it was given, mm
};

/// The spine runs along the longest axis of the mesh, in the middle across: over an open one that has a side
/// from rim to rim, seen from that side; over any other from end to end.
/// @throws InvalidInput for a mesh without area, or that its own middle plane does not cut
RibbedSurface ribbed_surface(const TriangleMesh& mesh);

/// Likewise over a patch, along the longer side of its rectangle (x where they are alike).
RibbedSurface ribbed_surface(const SurfacePatch& patch);

/// Likewise of a mesh whose spine is to run along x, in the middle across. @param has_side whether it is an open surface
/// that is seen from +z
RibbedSurface ribbed_along_x(const TriangleMesh& mesh, bool has_side);

/// The patch as triangles over its rectangle, mm.
TriangleMesh patch_mesh(const SurfacePatch& patch);

/// The section of a mesh by a plane through a point of it, from that point both ways: to the rim, or half way
/// round where it closes. The first goes to smaller x.
/// @param p on the mesh, mm   @param normal of the plane, not along x   @throws InvalidInput where the plane
/// does not cut the mesh
std::array<std::vector<Eigen::Vector3d>, 2> section_from(const TriangleMesh& mesh, const Eigen::Vector3d& p,
                                                         const Eigen::Vector3d& normal);

}  // namespace kinetix::targets
