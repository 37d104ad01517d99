#include "model/linkage/half_wall.hpp"

#include <Eigen/Geometry>

namespace kinetix::model {
namespace {

/// Returns the plate from the vertex along `edge` (unit) over `length`.
OrientedBox plate(const Eigen::Vector3d& edge, const Eigen::Vector3d& up, double length, double slant,
                  const CellSize& size) {
  OrientedBox box;
  box.slant = slant;
  box.center = 0.5 * length * edge;
  box.axes << edge, up, edge.cross(up);
  box.half << length / 2, size.height_mm / 2, size.thickness_mm / 2;
  return box;
}

}  // namespace

std::vector<HalfWall> half_walls(const Linkage& structure) {
  std::vector<HalfWall> all;
  all.reserve(structure.plates.size());
  const double L = structure.size.edge_mm;
  for (const Plate& p : structure.plates)
    all.push_back({p.body, p.hinge, plate(p.edge, p.up, p.length * L, p.slant, structure.size)});
  return all;
}

OrientedBox placed(const HalfWall& wall, const Pose& pose) {
  return {pose.p + pose.R * wall.box.center, pose.R * wall.box.axes, wall.box.half, wall.box.slant};
}

}  // namespace kinetix::model
