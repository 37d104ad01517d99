#include "sim/shapes/wall_prisms.hpp"

#include <cmath>

#include "model/linkage/half_wall.hpp"

namespace kinetix::sim {
namespace {

/// @param half of the plate, cell edges; @param slant length gained by the end at the hinge per height
Prism prism(const Eigen::Matrix3d& axes, const Eigen::Vector3d& half, double slant, double inset) {
  const double length = 2 * half.x() - inset * std::hypot(1, slant), height = half.y() - inset,
               thickness = half.z() - inset;
  Prism corners;
  int k = 0;
  for (const double h : {-height, height})
    for (const double w : {-thickness, thickness})
      for (const double u : {0.0, length + h * slant}) corners[k++] = axes * Eigen::Vector3d(u, h, w);
  return corners;
}

}  // namespace

std::vector<std::vector<WallPrism>> wall_prisms(const model::Linkage& structure, double inset) {
  std::vector<std::vector<WallPrism>> prisms(structure.bodies.size());
  const std::vector<model::HalfWall> walls = half_walls(structure);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const model::HalfWall& wall = walls[k];
    const Eigen::Vector3d half = wall.box.half / structure.size.edge_mm;
    const double slant = structure.plates[k].slant;
    prisms[wall.body].push_back({wall.hinge, prism(wall.box.axes, half, slant, inset)});
  }
  return prisms;
}

}  // namespace kinetix::sim
