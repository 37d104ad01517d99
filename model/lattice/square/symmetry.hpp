#pragma once

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Motions of the plane that may take a panel onto itself.
enum class PlaneMotion { none, mirror_x, mirror_y, half_turn, quarter_turn };

/// Where a motion takes a wall.
struct WallImage {
  int hinge = 0;
  bool reversed = false;  ///< turned end to end
};

/// @pre the panel is a rectangle from [0, 0]; square for a quarter turn
WallImage image(const Structure& panel, const Hinge& hinge, PlaneMotion motion);

}  // namespace kinetix::model
