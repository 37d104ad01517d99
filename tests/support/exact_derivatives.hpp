#pragma once

#include "model/lattice/square/family/exact_derivatives.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::testing {

/// Returns all parameters of a design in the order of ExactJacobian.
inline Eigen::VectorXd pack(const model::ExactDesign<double>& d) {
  Eigen::VectorXd x(2 * d.columns() + d.rows() + 2);
  int k = 0;
  for (const auto* part : {&d.beta, &d.t, &d.s})
    for (const double value : *part) x[k++] = value;
  x[k++] = d.gamma;
  x[k] = d.theta;
  return x;
}

/// @param x any indexable container of the scalar
template <class T, class Container>
model::ExactDesign<T> unpack(const Container& x, int columns, int rows) {
  auto d = model::ExactDesign<T>::basic(columns, rows);
  int k = 0;
  for (auto* part : {&d.beta, &d.t, &d.s})
    for (T& value : *part) value = x[k++];
  d.gamma = x[k++];
  d.theta = x[k];
  return d;
}

/// Returns the body positions, stacked, as a function of the packed parameters.
inline Eigen::VectorXd folded_positions(const Eigen::VectorXd& x, int columns, int rows, double L) {
  model::State poses;
  fold(unpack<double>(x, columns, rows), L, poses);
  Eigen::VectorXd p(3 * poses.size());
  for (std::size_t b = 0; b < poses.size(); ++b) p.segment<3>(3 * b) = poses[b].p;
  return p;
}

/// The analytic Jacobian of folded_positions.
inline Eigen::MatrixXd position_jacobian(const model::ExactDesign<double>& design, double L) {
  model::State poses;
  model::ExactJacobian jacobian;
  fold_with_jacobian(design, L, poses, jacobian);
  Eigen::MatrixXd J(3 * poses.size(), jacobian.parameters());
  for (int k = 0; k < jacobian.parameters(); ++k)
    for (std::size_t b = 0; b < poses.size(); ++b)
      J.block<3, 1>(3 * b, k) = jacobian.twist(k, static_cast<int>(b)).v;
  return J;
}

/// Relative difference of the analytic Jacobian and central differences.
inline double jacobian_mismatch(const model::ExactDesign<double>& design, double L) {
  const auto f = [&](const Eigen::VectorXd& x) {
    return folded_positions(x, design.columns(), design.rows(), L);
  };
  return relative_difference(position_jacobian(design, L), numeric_jacobian(f, pack(design)));
}

}  // namespace kinetix::testing
