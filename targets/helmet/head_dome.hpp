#pragma once

#include "targets/mesh/mesh_solid.hpp"

namespace kinetix::targets {

/// Where the dome is invented, because the mesh is open there.
struct DomeOpening {
  double width_mm = 0;  ///< across, at its widest
  double top_z = 0;     ///< of its highest place, mm, in the frame of the head that was given
};

/// The outer envelope of the top of a head as one clean sheet: seen from an inner point, the outermost place
/// in every direction that is evenly spread over a sphere (about one a square degree), down to dome_angle
/// from above. Inner shells, doubled and flipped triangles are gone, holes are closed; thin ears stand out as
/// they do.
struct HeadDome {
  TriangleMesh mesh;                  ///< mm; no holes, edges shared by at most two triangles, wound outward
  int closed = 0;                     ///< vertices of the mesh that lie over holes
  std::vector<DomeOpening> openings;  ///< those holes
};

/// Where the dome ends, rad from straight up as seen from the inner point: 30 deg below level. At
/// 80 mm from that point it is then 115 mm below the crown, past the coverage that is the default.
inline constexpr double dome_angle = 120 * 3.14159265358979323846 / 180;

/// @param core the inner point, mm, z up. Holes are closed by the membrane of the distance from it; what a
/// hole joins to the dome's rim is left open.
HeadDome head_dome(const MeshSolid& head, const Eigen::Vector3d& core);

}  // namespace kinetix::targets
