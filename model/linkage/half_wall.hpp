#pragma once

#include <vector>

#include "model/base/oriented_box.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A plate of a linkage with the wall's height and thickness, its end at the hinge cut along the hinge axis: slanted where alpha
/// is not 90 deg, as in prints. Contact ranges, equilibria and the physics run have this one shape of a wall.
struct HalfWall {
  int body = 0;
  int hinge = 0;
  OrientedBox box;  ///< relative to the body's position, mm
};

/// In the order of Linkage::plates.
std::vector<HalfWall> half_walls(const Linkage& structure);

/// The plate of a half wall in a state, mm.
OrientedBox placed(const HalfWall& wall, const Pose& pose);

}  // namespace kinetix::model
