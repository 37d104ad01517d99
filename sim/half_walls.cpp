#include "sim/half_walls.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kinetix {
namespace {

/// @param length along the edge from the vertex, negative for the half wall of the upper body
Prism half_wall(const Hinge& hinge, double length, double height, double thickness) {
  const HingeParameters& p = hinge.parameters;
  const Eigen::Vector3d e = edge_direction(hinge.wall.axis);
  const Eigen::Vector3d up = wall_up(hinge.wall.axis, p.beta);
  const Eigen::Vector3d across = e.cross(up);
  const double slant = std::cos(p.alpha) / std::sin(p.alpha);
  Prism corners;
  int k = 0;
  for (const double h : {-height / 2, height / 2})
    for (const double w : {-thickness / 2, thickness / 2})
      for (const double u : {0.0, length + h * slant}) corners[k++] = u * e + h * up + w * across;
  return corners;
}

}  // namespace

std::vector<std::vector<HalfWall>> half_walls(const Structure& structure, double inset) {
  const double height = structure.size.height_mm / structure.size.edge_mm - 2 * inset;
  const double thickness = structure.size.thickness_mm / structure.size.edge_mm - 2 * inset;
  std::vector<std::vector<HalfWall>> walls(structure.bodies.size());
  for (std::size_t k = 0; k < structure.hinges.size(); ++k) {
    const Hinge& hinge = structure.hinges[k];
    const int index = static_cast<int>(k);
    const double t = hinge.parameters.t;
    walls[hinge.lower].push_back({index, half_wall(hinge, t - inset, height, thickness)});
    walls[hinge.upper].push_back({index, half_wall(hinge, t - 1 + inset, height, thickness)});
  }
  return walls;
}

}  // namespace kinetix
