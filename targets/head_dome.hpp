#pragma once

#include "targets/triangle_tree.hpp"

namespace kinetix {

/// The outer envelope of the top of a head as one clean sheet: seen from an inner point, the outermost place
/// in every direction that is evenly spread over a sphere (about one a square degree), down to dome_angle
/// from above. Inner shells, doubled and flipped triangles are gone, holes are closed.
struct HeadDome {
  TriangleMesh mesh;  ///< no holes, edges shared by at most two triangles, wound outward
  int closed = 0;     ///< vertices of the mesh that lie over holes
};

/// Where the dome ends, rad from straight up as seen from the inner point.
inline constexpr double dome_angle = 120 * 3.14159265358979323846 / 180;

/// @param core the inner point, z up. Holes are closed by the membrane of the distance from it; what a hole
/// joins to the dome's rim is left open.
HeadDome head_dome(const TriangleTree& head, const Eigen::Vector3d& core);

}  // namespace kinetix
