#pragma once

#include "app/print/print_sheet.hpp"

namespace kinetix::app {

/// The least distance of solids of two bodies.
struct LeastDistance {
  double mm = 0;                                    ///< negative: how deep they are in each other, mm
  int first = -1, second = -1;                      ///< bodies; -1: there are no two
  double theta = 0;                                 ///< rad
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< between them, in the state at theta, mm
};

/// What is left between the solids from flat to the fold.
struct PathClearance {
  double asked_mm = 0;      ///< a pin's clearance; of blocks and films 0: walls may not run into each other
  LeastDistance in_hinges;  ///< of two bodies that share a hinge, mm
  LeastDistance elsewhere;  ///< of all others, mm

  const LeastDistance& least() const { return in_hinges.mm < elsewhere.mm ? in_hinges : elsewhere; }
};

/// Exact distances of the solids' convex pieces (Gilbert, Johnson and Keerthi's method, Bullet's in double precision) in
/// every state of the path. A rod and its bore are compared by their axes, as both are round.
PathClearance path_clearance(const PrintSheet& sheet);

/// Whether what is left is at least what was asked, but for 0.01 mm of the circles' polygons.
bool is_kept(const PathClearance& clearance);

}  // namespace kinetix::app
