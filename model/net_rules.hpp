#pragma once

#include <string>

#include "model/structure.hpp"

namespace kinetix {

/// Whether a structure is a net (model/net.hpp).
struct NetCheck {
  std::size_t broken = 0;   ///< number of hinges that break a rule; 0 for a net
  int breaking_hinge = -1;  ///< the first of them
  std::string rule;         ///< that it breaks
};

/// The rules of family F4: alpha = 90 deg; the walls of a crease have one tilt, its sign alternating, and
/// give one fraction to their class-A vertices; a crease with a tilt has t = 1/2, and so have the walls
/// beside it in its cells, which have no tilt; around every hole the hinges close, computed along the motion
/// (a closed ring of cells may hold creases along x or along y but not both, and those in line need one
/// tilt).
/// @param tolerance on fractions (absolute) and angles (rad)
NetCheck check_net(const Structure& structure, double tolerance = 1e-9);

}  // namespace kinetix
