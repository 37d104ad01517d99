#include "model/half_wall.hpp"

#include <Eigen/Geometry>

namespace kinetix {
namespace {

/// Plate from the vertex along `edge` (unit) over `length`.
OrientedBox plate(const Eigen::Vector3d& edge, const Eigen::Vector3d& up, double length,
                  const CellSize& size) {
  OrientedBox box;
  box.center = 0.5 * length * edge;
  box.axes << edge, up, edge.cross(up);
  box.half << length / 2, size.height_mm / 2, size.thickness_mm / 2;
  return box;
}

}  // namespace

std::vector<HalfWall> half_walls(const Structure& structure) {
  std::vector<HalfWall> all;
  all.reserve(2 * structure.hinges.size());
  const double L = structure.size.edge_mm;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const Hinge& hinge = structure.hinges[h];
    const Eigen::Vector3d edge = edge_direction(hinge.wall.axis);
    const Eigen::Vector3d up = wall_up(hinge.wall.axis, hinge.parameters.beta);
    const double t = hinge.parameters.t;
    all.push_back({hinge.lower, h, plate(edge, up, t * L, structure.size)});
    all.push_back({hinge.upper, h, plate(-edge, up, (1 - t) * L, structure.size)});
  }
  return all;
}

OrientedBox placed(const HalfWall& wall, const Pose& pose) {
  return {pose.p + pose.R * wall.box.center, pose.R * wall.box.axes, wall.box.half};
}

}  // namespace kinetix
