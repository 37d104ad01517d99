#pragma once

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Motions of the plane that may map a panel onto itself.
enum class PlaneMotion { none, mirror_x, mirror_y, half_turn, quarter_turn };

/// Image of a wall under a motion.
struct WallImage {
  int hinge = 0;
  bool reversed = false;  ///< true: its ends are exchanged
};

/// Returns the image of a hinge's wall. @pre the panel is a rectangle from [0, 0]; square for a quarter turn
WallImage image(const Structure& panel, const Hinge& hinge, PlaneMotion motion);

}  // namespace kinetix::model
