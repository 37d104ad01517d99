#pragma once

#include "model/linkage/exact_motion.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Returns the degrees of freedom of a planar linkage with independent joints, by Eq. 1: 3 (N - 1 - j) + sum
/// of f. A panel has dependent joints: its count is below its true degrees of freedom.
/// @param bodies N >= 1   @param joints j >= 0   @param dofs sum of f >= 0, one for each hinge
/// @throws InvalidInput for an argument out of range
int gruebler_planar(int bodies, int joints, int dofs);

/// Returns the degrees of freedom of a spatial linkage with independent joints: 6 (N - 1 - j) + sum of f.
int gruebler_spatial(int bodies, int joints, int dofs);

/// First-order motions of a structure in one state: the twists that close every hinge to first order.
struct NullSpace {
  /// 6 x bodies rows as in closure.hpp (rad, cell edges), orthonormal columns; body 0 does not move.
  Eigen::MatrixXd basis;
  /// Largest singular value of the closure Jacobian that counts as zero, dimensionless
  double largest_zero = 0;
  /// Next singular value, dimensionless: a large gap makes the number of dofs certain
  double smallest_other = 0;

  int dofs() const { return static_cast<int>(basis.cols()); }
};

/// Method for the singular values: dense decomposition, O(bodies^3), or inverse iteration on a block of
/// vectors with a sparse factorisation. `automatic` is dense up to 20 bodies. Inverse iteration takes a
/// second for a sheet of 60 x 60 cells. (A sparse rank-revealing QR takes 8 s for 20 x 20.)
enum class NullSpaceMethod { automatic, dense, inverse_iteration };

/// Computes the first-order motions of a state. Singular values up to 1e-8 count as zero (the largest is
/// about 3; on sheets of 10 x 10 cells the smallest proper one is about 1e-2). A constraint of smaller
/// singular value is not detected. Each call gives the same result.
/// @pre state.size() == structure.bodies.size() >= 2
NullSpace null_space(const Linkage& structure, const State& state,
                     NullSpaceMethod method = NullSpaceMethod::automatic);

enum class Verdict {
  mobile,      ///< a finite motion was followed from flat and closed in every state
  not_mobile,  ///< no first-order motion, or the only one does not continue
  undecided,   ///< none of several first-order motions that were tried continues, or a search did not end
};

std::string to_string(Verdict verdict);

/// Degrees of freedom of a structure at its flat state.
struct Mobility {
  std::optional<int> gruebler_planar;  ///< Eq. 1, if all hinge axes are vertical
  int gruebler_spatial = 0;
  int dofs_flat = 0;   ///< first-order motions at flat; exceeds the finite ones if flat is singular
  int dofs_along = 0;  ///< first-order motions in the state after `turn`; 0 unless mobile
  Verdict verdict = Verdict::undecided;
  double turn = 0;    ///< largest turn of the driven hinge on the best motion tried, rad
  double misfit = 0;  ///< largest entry of the closure residual on that motion, rad or cell edges
  std::string why;    ///< one sentence that explains the verdict
};

struct MobilityOptions {
  double turn = 0.3;      ///< rad, (0, 1]; turn up to which a motion is followed
  int steps = 12;         ///< >= 2; states to close during the motion
  double closed = 1e-10;  ///< > 0; residual, rad or cell edges, up to which a state counts as closed
  int combinations = 6;   ///< >= 0; random directions to try if flat has several first-order motions
  unsigned seed = 1;      ///< seed of the random directions

  /// @throws InvalidInput
  void validate() const;
};

/// Counts degrees of freedom by Eq. 1, by the rank of the closure Jacobian at flat, and by its rank after a
/// finite motion. Only the last is reliable: near flat the counts err both ways.
///
/// Each verdict holds to rounding and to the tolerances above.
/// `mobile`: `steps` closed states, each found from the one before, lead from flat to `turn`. The last one
/// still has a first-order motion, and `dofs_along` is an upper bound of the degrees of freedom there.
/// `not_mobile` without a first-order motion: rigid. `not_mobile` with just one: every motion from flat would
/// have to start along it. Driven along it to both sides, the hinges keep a misfit. A misfit below `closed`
/// would be missed, for example with tilts of about 3e-4 rad.
/// `undecided`: only the basis of the first-order motions and random combinations of it were driven.
///
/// Meant for up to about 30 x 30 cells (20 x 20 takes a second, 30 x 30 about ten), and 100 x 100 if a closed
/// form is known.
/// @param exact closed form, which is followed first; {} if none is known
/// @throws InvalidInput for options out of range
Mobility mobility(const Linkage& structure, const ExactMotion& exact, const MobilityOptions& options = {});

}  // namespace kinetix::model
