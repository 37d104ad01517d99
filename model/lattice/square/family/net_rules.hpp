#pragma once

#include <string>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Result of the test for a net (model/lattice/square/family/net.hpp).
struct NetCheck {
  std::size_t broken = 0;   ///< number of hinges that break a rule; 0 for a net
  int breaking_hinge = -1;  ///< the first of them
  std::string rule;         ///< rule that this hinge breaks
};

/// Tests the rules of family F4:
/// - Every hinge has alpha = 90 deg.
/// - The walls of a crease have one tilt of alternating sign, and one fraction at their vertices of sublattice A.
/// - A crease with a tilt has t = 1/2, and so have the walls next to it in its cells.
/// - Creases with a tilt may cross if in every block of 2 x 2 cells the columns or the rows have one tilt
/// (model/lattice/square/family/fold_angles.hpp).
/// - The hinges around every hole close, as computed along the motion. Creases in line with each other need one tilt,
/// and may not cross in the hole.
///
/// The rules are also necessary for structures of alpha = 90 deg and t = 1/2 that are connected by walls. Without
/// holes, a sheet that breaks a rule is rigid or moves only to first order.
/// @param tolerance on fractions (absolute) and angles (rad)
NetCheck check_net(const Structure& structure, double tolerance = 1e-9);

}  // namespace kinetix::model
