#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::bench {

/// Flat lattice of cells of two crosses each, one above the other. A pin joins the two crosses of a cell at their
/// centres. Pins join the tips of an upper cross to the lower crosses of the next cells. So the crosses are two panels, which are
/// in turn above and below each other. All pins have the same clearance.
struct CrossedLattice {
  int side = 5;           ///< cells along x and along y, > 1
  double arm_mm = 0;      ///< from the centre of a cross to the pin at its tip, > spacing_mm / 2
  double spacing_mm = 0;  ///< of the cells before the pull
  double play_mm = 0;     ///< clearance per side, > 0
};

/// Displacements of cells under a pull.
struct PulledLattice {
  std::vector<Eigen::Vector2d> moved_mm = {};  ///< index side * i + j for cell (i, j)
  bool converged = false;
};

/// Pulls a cell in the plane, with both crosses of cell (0, 0) held. Minimises the energy of all pins, by the program's
/// law of clearance (model/hinge/clearance_energy.hpp) with 1000 N/mm, less the work of the force. At the end of the
/// play the lattice is taut between the held and the pulled cell.
/// @param force N; 0.1 N stretches pins by less than 0.001 mm
PulledLattice pull(const CrossedLattice& lattice, int i, int j, const Eigen::Vector2d& force);

}  // namespace kinetix::bench
