#pragma once

#include <Eigen/Core>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// First-order motions of a structure in one state: the twists that close every hinge to first order.
struct NullSpace {
  /// 6 x bodies rows as in closure.hpp (rad, cell edges), orthonormal columns; body 0 does not move.
  Eigen::MatrixXd basis;
  double largest_zero = 0;  ///< largest singular value of the closure Jacobian that counts as zero; this
                            ///< and the next are dimensionless: rad and cell edges by rad and cell edges
  double smallest_other =
      0;  ///< the next one: the larger this gap, the surer the number of degrees of freedom

  int dofs() const { return static_cast<int>(basis.cols()); }
};

/// How the singular values are found: by dense decomposition, O(bodies^3), or by inverse iteration on a block
/// of vectors with a sparse factorisation. `automatic` takes the dense one up to 20 bodies; the other takes
/// a second for a sheet of 60 x 60 cells. (A sparse rank-revealing QR takes 8 s for 20 x 20.)
enum class NullSpaceMethod { automatic, dense, inverse_iteration };

/// Singular values up to 1e-8 count as zero (the largest is about 3; on sheets of 10 x 10 cells the
/// smallest proper one is about 1e-2). A degree of freedom that is first lost at a smaller value is not seen.
/// Same result on every call. @pre state.size() == structure.bodies.size() >= 2
NullSpace null_space(const Linkage& structure, const State& state,
                     NullSpaceMethod method = NullSpaceMethod::automatic);

}  // namespace kinetix::model
