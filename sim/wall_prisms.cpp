#include "sim/wall_prisms.hpp"

#include <cmath>

#include "model/half_wall.hpp"

namespace kinetix {
namespace {

/// @param half of the plate, cell edges; @param slant length that the end at the hinge gains per height
Prism prism(const Eigen::Matrix3d& axes, const Eigen::Vector3d& half, double slant, double inset) {
  const double length = 2 * half.x() - inset, height = half.y() - inset, thickness = half.z() - inset;
  Prism corners;
  int k = 0;
  for (const double h : {-height, height})
    for (const double w : {-thickness, thickness})
      for (const double u : {0.0, length + h * slant}) corners[k++] = axes * Eigen::Vector3d(u, h, w);
  return corners;
}

}  // namespace

std::vector<std::vector<WallPrism>> wall_prisms(const Structure& structure, double inset) {
  std::vector<std::vector<WallPrism>> prisms(structure.bodies.size());
  for (const HalfWall& wall : half_walls(structure)) {
    const Hinge& hinge = structure.hinges[wall.hinge];
    const double slant = std::cos(hinge.parameters.alpha) / std::sin(hinge.parameters.alpha);
    const Eigen::Vector3d half = wall.box.half / structure.size.edge_mm;
    const bool runs_with_the_edge = wall.body == hinge.lower;
    prisms[wall.body].push_back(
        {wall.hinge, prism(wall.box.axes, half, runs_with_the_edge ? slant : -slant, inset)});
  }
  return prisms;
}

}  // namespace kinetix
