#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::sim {

/// Corners of a convex prism; cell edges, in the frame of its body (rest orientation, origin on the vertex).
using Prism = std::array<Eigen::Vector3d, 8>;

/// Half wall as a collision shape.
struct WallPrism {
  int hinge = 0;  ///< index of the hinge at its end
  Prism prism;
};

/// Returns the half walls of each body (model/linkage/half_wall.hpp), with the end at the hinge cut along the
/// hinge axis: slanted unless alpha is 90 deg.
/// @param inset distance by which the faces are moved inwards, except the one at the vertex; cell edges,
/// below half the thickness
std::vector<std::vector<WallPrism>> wall_prisms(const model::Linkage& structure, double inset = 0);

}  // namespace kinetix::sim
