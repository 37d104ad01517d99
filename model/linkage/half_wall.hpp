#pragma once

#include <vector>

#include "model/base/oriented_box.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A plate of a linkage with the wall's height and thickness, its end at the hinge cut along the hinge axis: slanted where alpha
/// is not 90 deg, as in the physics run and in prints.
struct HalfWall {
  int body = 0;
  int hinge = 0;
  OrientedBox box;  ///< relative to the body's position, mm
};

/// A linkage whose plates end square to their edge, whatever alpha is: as contact of equilibria has them.
Linkage with_square_ends(Linkage structure);

/// In the order of Linkage::plates.
std::vector<HalfWall> half_walls(const Linkage& structure);

/// The plate of a half wall in a state, mm.
OrientedBox placed(const HalfWall& wall, const Pose& pose);

}  // namespace kinetix::model
