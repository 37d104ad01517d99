#include "model/contact/linkage_plates.hpp"

#include <algorithm>
#include <cmath>

namespace kinetix::model {

LinkagePlates::LinkagePlates(const Linkage& structure, const std::vector<TurnLaw>& turns, double growth_mm)
    : LinkageMotion(structure, turns),
      walls(half_walls(structure)),
      at_rest(structure),
      plates_of(structure.bodies.size()),
      reach(structure.bodies.size()) {
  for (int k = 0; k < static_cast<int>(walls.size()); ++k) {
    HalfWall& wall = walls[k];
    // A slanted end that moves out by this distance moves farther along the edge.
    wall.box.half += growth_mm * Eigen::Vector3d(std::hypot(1, wall.box.slant), 1, 1);
    plates_of[wall.body].push_back(k);
    reach[wall.body] = std::max(reach[wall.body], wall.box.center.norm() + radius(wall.box));
  }
}

bool LinkagePlates::can_touch(const WallPair& pair) const {
  return walls[pair.first].hinge != walls[pair.second].hinge &&
         !std::binary_search(at_rest.touching_at_rest().begin(), at_rest.touching_at_rest().end(), pair);
}

}  // namespace kinetix::model
