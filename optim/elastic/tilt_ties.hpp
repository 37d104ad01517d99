#pragma once

#include "model/base/geometry.hpp"
#include "model/lattice/lattice.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Hinges with tilts of equal size that belong together: a column of a strip, or a crease. The conditions of
/// the exact families on tilts hold as long as these stay equal.
struct TiltTie {
  std::vector<int> hinges;
  std::vector<int> signs;  ///< of each hinge's tilt, 1 or -1
  double tilt = 0;         ///< its size, rad, > 0
  /// Allowed tilts, rad; below 0 all signs are reversed.
  AngleRange range = {-pi / 2, pi / 2};
};

/// Returns ties of walls with one direction and tilts of one size whose middles are on one line across them.
/// Hinges without tilt belong to no tie.
std::vector<TiltTie> tilt_ties(const model::Lattice& sheet);

/// Returns the sheet with other tilts, rad, one per tie.
model::Lattice with_tilts(model::Lattice sheet, const std::vector<TiltTie>& ties,
                          const std::vector<double>& tilts);

}  // namespace kinetix::optim
