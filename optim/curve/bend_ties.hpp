#pragma once

#include <vector>

#include "model/lattice/square/structure.hpp"
#include "optim/matter/tilt_ties.hpp"
#include "optim/solvers/variables.hpp"

namespace kinetix::optim {

/// Map from few variables to the tilts of all columns.
///
/// Column c turns the strip by 2 atan(tan(beta_c) sin(theta)) with a sign that alternates with c. Equal tilts
/// in neighbouring columns cancel (paper section 5.2). The ties are between *turns*: beta_c = sign_c *
/// x[variable_c], rad.
struct BendTies {
  std::vector<int> variable;  ///< of each column
  std::vector<double> sign;   ///< of each column, 1 or -1, such that x > 0 turns every column the same way
  std::vector<AngleRange> range;  ///< of each variable: values that keep all its columns within bounds

  int columns() const { return static_cast<int>(variable.size()); }
  int variables() const { return static_cast<int>(range.size()); }
};

/// Ties the columns of a strip.
/// @param per column or all
/// @param symmetry of the folded shape. mirror_x and rotate_2 make column N-1-c turn as c does; every curve
/// has mirror_y.
/// @throws InvalidInput for other ties, which leave the exact family, and for a variable whose range is empty
BendTies make_bend_ties(int columns, Per per, Symmetry symmetry, AngleRange beta);

/// Returns the tilts that a search under these ties has found. Ties and ranges are those of the search.
std::vector<TiltTie> tied_tilts(const model::Structure& strip, const BendTies& ties);

}  // namespace kinetix::optim
