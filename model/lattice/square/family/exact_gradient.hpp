#pragma once

#include <Eigen/Core>

#include "model/lattice/square/family/exact_family.hpp"

namespace kinetix::model {

/// Derivatives of a function of the state by every parameter of an exact design, in the design's own form: one pass back
/// over the bodies, the adjoint of fold()'s recursion, where ExactJacobian has a column a parameter.
/// @param L cell edge, mm   @param poses that fold() gave, mm
/// @param by_state of the function, 6 a body in the order of `poses`: by a turn about the world's axes through its position
/// (per rad), then by a shift (per mm)
/// @param gradient becomes them: per rad, or per unit of a fraction. Buffers are reused
void fold_gradient(const ExactDesign<double>& design, double L, const State& poses,
                   const Eigen::VectorXd& by_state, ExactDesign<double>& gradient);

}  // namespace kinetix::model
