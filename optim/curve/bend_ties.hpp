#pragma once

#include <vector>

#include "model/lattice/square/structure.hpp"
#include "optim/matter/tilt_ties.hpp"
#include "optim/solvers/variables.hpp"

namespace kinetix::optim {

/// How the tilts of the columns follow from fewer variables.
///
/// Column c turns the strip by 2 atan(tan(beta_c) sin(theta)) with a sign that alternates with c (equal tilts
/// in neighbouring columns cancel, paper section 5.2). Ties are between *turns*: beta_c = sign_c *
/// x[variable_c], rad.
struct BendTies {
  std::vector<int> variable;  ///< of each column
  std::vector<double> sign;   ///< of each column, 1 or -1, such that x > 0 turns every column the same way
  std::vector<AngleRange> range;  ///< of each variable: where all its columns are within bounds

  int columns() const { return static_cast<int>(variable.size()); }
  int variables() const { return static_cast<int>(range.size()); }
};

/// @param per column or all; @param symmetry of the folded shape: mirror_x and rotate_2 make column N-1-c
/// turn as c does, mirror_y holds for every curve.
/// @throws InvalidInput for other ties, which leave the exact family, and where the range leaves a variable
/// nothing
BendTies make_bend_ties(int columns, Per per, Symmetry symmetry, AngleRange beta);

/// The tilts of a strip that a search under these ties has found, tied as it had them, within its ranges.
std::vector<TiltTie> tied_tilts(const model::Structure& strip, const BendTies& ties);

}  // namespace kinetix::optim
