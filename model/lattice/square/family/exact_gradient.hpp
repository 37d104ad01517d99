#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/base/lanes.hpp"
#include "model/lattice/square/family/exact_family.hpp"

namespace kinetix::model {

/// Derivatives of a function of the state by every parameter of an exact design, in the design's own form: one pass back
/// over the bodies, the adjoint of fold()'s recursion, where ExactJacobian has a column a parameter.
/// @tparam T double, or Lanes for two designs at once
/// @param L cell edge, mm   @param poses that fold() gave, mm
/// @param by_state of the function, 6 a body in the order of `poses`: by a turn about the world's axes through its position
/// (per rad), then by a shift (per mm)
/// @param gradient becomes them: per rad, or per unit of a fraction. Buffers are reused
template <class T>
void fold_gradient(const ExactDesign<T>& design, double L, const std::vector<PoseOf<T>>& poses,
                   const Eigen::Matrix<T, Eigen::Dynamic, 1>& by_state, ExactDesign<T>& gradient);

extern template void fold_gradient(const ExactDesign<double>&, double, const State&, const Eigen::VectorXd&,
                                   ExactDesign<double>&);
extern template void fold_gradient(const ExactDesign<Lanes>&, double, const std::vector<PoseOf<Lanes>>&,
                                   const Eigen::Matrix<Lanes, Eigen::Dynamic, 1>&, ExactDesign<Lanes>&);

}  // namespace kinetix::model
