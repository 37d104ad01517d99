#pragma once

#include <vector>

#include "model/base/oriented_box.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A plate of a linkage with the wall's height and thickness. Its end at the hinge is cut along the hinge
/// axis, and is slanted if alpha is not 90 deg, as in prints. Contact ranges, equilibria and the simulation
/// share this shape.
struct HalfWall {
  int body = 0;
  int hinge = 0;
  OrientedBox box;  ///< relative to the body's position, mm
};

/// Returns the half walls in the order of Linkage::plates.
std::vector<HalfWall> half_walls(const Linkage& structure);

/// Returns the plate of a half wall in a state, mm.
OrientedBox placed(const HalfWall& wall, const Pose& pose);

}  // namespace kinetix::model
