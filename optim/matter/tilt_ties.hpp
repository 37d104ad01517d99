#pragma once

#include <vector>

#include "model/base/angle.hpp"
#include "model/lattice/lattice.hpp"
#include "optim/solvers/variables.hpp"

namespace kinetix::optim {

/// Hinges whose tilts are equal in size and belong together: a column of a strip, or a crease. What the exact
/// families ask of tilts holds as long as these stay equal.
struct TiltTie {
  std::vector<int> hinges;
  std::vector<int> signs;  ///< of each hinge's tilt, 1 or -1
  double tilt = 0;         ///< its size, rad, > 0
  /// What that may become, below 0 with all signs turned over, rad.
  AngleRange range = {-pi / 2, pi / 2};
};

/// Walls of one direction, with tilts of one size, whose middles lie on one line across them. Hinges that stand
/// upright belong to none.
std::vector<TiltTie> tilt_ties(const model::Lattice& sheet);

/// The sheet with other tilts, rad, one of each tie.
model::Lattice with_tilts(model::Lattice sheet, const std::vector<TiltTie>& ties,
                          const std::vector<double>& tilts);

}  // namespace kinetix::optim
