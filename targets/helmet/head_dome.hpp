#pragma once

#include "targets/mesh/mesh_solid.hpp"

namespace kinetix::targets {

/// Part of the dome that is invented because the mesh is open there.
struct DomeOpening {
  double width_mm = 0;  ///< across, at its widest
  double top_z = 0;     ///< of its highest place, mm, in the frame of the head that was given
};

/// Outer envelope of the top of a head as one clean sheet. It joins the outermost places in all directions from an
/// inner point, down to dome_angle from above. The directions are evenly spread over a sphere, about one per square
/// degree. Inner shells, doubled and flipped triangles are gone, and holes are closed. Thin ears protrude as in the
/// mesh.
struct HeadDome {
  TriangleMesh mesh;                  ///< mm; no holes, edges shared by at most two triangles, wound outward
  int closed = 0;                     ///< vertices of the mesh that lie over holes
  std::vector<DomeOpening> openings;  ///< those holes
};

/// End of the dome, rad from straight up as seen from the inner point: 30 deg below level. At 80 mm from that point it
/// is then 115 mm below the crown, past the default coverage.
inline constexpr double dome_angle = 120 * 3.14159265358979323846 / 180;

/// Finds the dome. Holes are closed by the membrane of the distance from the inner point. A hole that reaches the
/// dome's boundary is left open.
/// @param core the inner point, mm, z up
HeadDome head_dome(const MeshSolid& head, const Eigen::Vector3d& core);

}  // namespace kinetix::targets
