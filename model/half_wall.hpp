#pragma once

#include <vector>

#include "model/oriented_box.hpp"
#include "model/state.hpp"

namespace kinetix {

/// The part of a wall that belongs to one body: a plate from the vertex to the hinge, of the wall's height
/// and thickness, tilted with the wall about its neutral axis, ends square to the edge.
struct HalfWall {
  int body = 0;
  int hinge = 0;
  OrientedBox box;  ///< relative to the body's position, mm
};

/// Two for each hinge, at 2 hinge (the lower body's) and 2 hinge + 1.
std::vector<HalfWall> half_walls(const Structure& structure);

/// The plate of a half wall in a state.
OrientedBox placed(const HalfWall& wall, const Pose& pose);

}  // namespace kinetix
