#pragma once

#include <Eigen/Core>

#include "model/linkage/state.hpp"

namespace kinetix::model {

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

}  // namespace kinetix::model
