#pragma once

#include <optional>
#include <string>

#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

enum class Verdict {
  mobile,      ///< a finite motion was followed from flat, closed all the way
  not_mobile,  ///< no first-order motion, or the only one there is does not go on
  undecided,   ///< several first-order motions and none of those tried goes on, or a search that did not end
};

std::string to_string(Verdict verdict);

/// How freely a structure moves from its flat state.
struct Mobility {
  std::optional<int> gruebler_planar;  ///< Eq. 1, where all hinge axes are vertical
  int gruebler_spatial = 0;
  int dofs_flat = 0;  ///< first-order motions at flat; more than there are finite ones where flat is singular
  int dofs_along = 0;  ///< the same in the state `turn` away: 0 unless mobile
  Verdict verdict = Verdict::undecided;
  double turn = 0;    ///< how far a hinge was driven on the best motion tried, rad
  double misfit = 0;  ///< largest entry of the closure residual met on it, rad or cell edges
  std::string why;    ///< one sentence
};

struct MobilityOptions {
  double turn = 0.3;      ///< rad, (0, 1]; how far to follow
  int steps = 12;         ///< >= 2; states to close on the way
  double closed = 1e-10;  ///< > 0; residual, rad or cell edges, up to which a state counts as closed
  int combinations = 6;   ///< >= 0; random directions to try where flat has several first-order motions
  unsigned seed = 1;      ///< of these

  /// @throws InvalidInput
  void validate() const;
};

/// Counts degrees of freedom by Eq. 1, by the rank of the closure Jacobian at flat, and by its rank after a
/// finite motion, which is the one that tells: near flat the counts are fooled both ways.
///
/// What is shown, to rounding and to the tolerances above: `mobile`, that `steps` closed states, each found
/// from the one before, lead from flat to `turn`, and that the last one still has a first-order motion;
/// `dofs_along` is an upper bound of the degrees of freedom there. `not_mobile` without a first-order motion:
/// rigid. `not_mobile` with just one: every motion from flat would have to start along it, and driven that
/// way, to both sides, the hinges keep a misfit; a misfit below `closed` would be missed, as with tilts of
/// some 3e-4 rad. `undecided`: only the basis of the first-order motions and random combinations of it were
/// driven.
///
/// Meant for up to some 30 x 30 cells (20 x 20 takes a second, 30 x 30 some ten), and 100 x 100 where a
/// closed form is known.
/// @param exact its closed form, which is followed first; {} where none is known
/// @throws InvalidInput for options out of range
Mobility mobility(const Linkage& structure, const ExactMotion& exact, const MobilityOptions& options = {});

}  // namespace kinetix::model
