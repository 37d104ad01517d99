#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/base/lanes.hpp"
#include "model/lattice/square/family/exact_family.hpp"

namespace kinetix::model {

/// Computes the derivatives of a function of the state by every parameter of an exact design. They have the form of a
/// design. The method is one backward pass over the bodies, the adjoint of fold()'s recursion. ExactJacobian has a
/// column per parameter instead.
/// @tparam T double, or Lanes for two designs at once.
/// @param L cell edge, mm   @param poses result of fold(), mm.
/// @param by_state derivative of the function, 6 per body in the order of `poses`. The first three are by a turn
/// about the world's axes through its position (per rad), the others by a shift (per mm).
/// @param gradient is set to the derivatives: per rad, or per unit of a fraction. Buffers are reused
template <class T>
void fold_gradient(const ExactDesign<T>& design, double L, const std::vector<PoseOf<T>>& poses,
                   const Eigen::Matrix<T, Eigen::Dynamic, 1>& by_state, ExactDesign<T>& gradient);

extern template void fold_gradient(const ExactDesign<double>&, double, const State&, const Eigen::VectorXd&,
                                   ExactDesign<double>&);
extern template void fold_gradient(const ExactDesign<Lanes>&, double, const std::vector<PoseOf<Lanes>>&,
                                   const Eigen::Matrix<Lanes, Eigen::Dynamic, 1>&, ExactDesign<Lanes>&);

}  // namespace kinetix::model
