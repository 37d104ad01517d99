#pragma once

#include <string>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Whether a structure is a net (model/lattice/square/family/net.hpp).
struct NetCheck {
  std::size_t broken = 0;   ///< number of hinges that break a rule; 0 for a net
  int breaking_hinge = -1;  ///< the first of them
  std::string rule;         ///< that it breaks
};

/// The rules of family F4: alpha = 90 deg; the walls of a crease have one tilt, its sign alternating, and
/// give one fraction to their class-A vertices; a crease with a tilt has t = 1/2, and so have the walls
/// beside it in its cells; creases with a tilt cross only where, in every block of 2 x 2 cells, the columns
/// or the rows have one tilt (model/lattice/square/family/fold_angles.hpp); around every hole the hinges close,
/// computed along the motion (creases in line with each other need one tilt, and may not cross in the hole).
///
/// For structures of alpha = 90 deg and t = 1/2 that hang together by walls the rules are not only
/// sufficient: without holes every sheet that breaks one is rigid or moves to first order alone.
/// @param tolerance on fractions (absolute) and angles (rad)
NetCheck check_net(const Structure& structure, double tolerance = 1e-9);

}  // namespace kinetix::model
