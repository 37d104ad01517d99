#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace kinetix::testing {

/// Jacobian of f at x by central differences with one step of Richardson extrapolation: error O(step^4).
/// @param f maps an n-vector to an m-vector
template <class Function>
Eigen::MatrixXd numeric_jacobian(const Function& f, const Eigen::VectorXd& x, double step = 1e-3) {
  const auto difference = [&](int k, double h) -> Eigen::VectorXd {
    Eigen::VectorXd plus = x, minus = x;
    plus[k] += h;
    minus[k] -= h;
    return (f(plus) - f(minus)) / (plus[k] - minus[k]);
  };
  Eigen::MatrixXd jacobian;
  for (int k = 0; k < x.size(); ++k) {
    const Eigen::VectorXd column = (4 * difference(k, step / 2) - difference(k, step)) / 3;
    if (k == 0) jacobian.resize(column.size(), x.size());
    jacobian.col(k) = column;
  }
  return jacobian;
}

/// Returns the largest difference over the largest entry (or 1, whichever is larger).
inline double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / std::max(1.0, b.cwiseAbs().maxCoeff());
}

/// Returns the largest difference of a and b over the largest entry of b in the same row and group of columns. The
/// divisor is at least a thousandth of the row's largest entry. @param groups widths of the groups
inline double relative_difference_by_groups(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                            const std::vector<Eigen::Index>& groups) {
  double worst = 0;
  for (Eigen::Index r = 0; r < b.rows(); ++r) {
    const double least = 1e-3 * b.row(r).cwiseAbs().maxCoeff();
    Eigen::Index from = 0;
    for (const Eigen::Index width : groups) {
      const auto difference = (a - b).row(r).segment(from, width).cwiseAbs().maxCoeff();
      const double size = std::max(least, b.row(r).segment(from, width).cwiseAbs().maxCoeff());
      worst = std::max(worst, difference > 0 ? difference / size : 0.0);
      from += width;
    }
  }
  return worst;
}

/// Compares analytic derivatives with central differences. Every cost and constraint passes this check.
template <class Function>
void expect_jacobian(const Function& f, const Eigen::VectorXd& x, const Eigen::MatrixXd& analytic,
                     double tolerance = 1e-7, double step = 1e-3) {
  const Eigen::MatrixXd numeric = numeric_jacobian(f, x, step);
  ASSERT_EQ(analytic.rows(), numeric.rows());
  ASSERT_EQ(analytic.cols(), numeric.cols());
  EXPECT_LE(relative_difference(analytic, numeric), tolerance) << "at x = " << x.transpose();
}

}  // namespace kinetix::testing
