#pragma once

#include "model/lattice/square/family/exact_family.hpp"
#include "optim/curve/curve_fit.hpp"
#include "optim/solvers/solver.hpp"
#include "python/bindings/custom_error.hpp"

namespace kinetix::python {

/// Fit of a strip (family F2) to a user's error. x = (bends of optim/curve/curve_fit.hpp, theta), rad. The Jacobian is
/// exact with the gradient of the error, otherwise by central differences over x.
class CustomFit final : public optim::LeastSquaresProblem {
 public:
  /// @param cell_mm cell edge.   @param theta bounds, rad. The error is kept by reference and must have been called
  /// once
  CustomFit(const CustomError& error, optim::BendTies ties, int rows, double cell_mm,
            optim::AngleRange theta);

  /// Sets the token that ends all evaluations when requested. A call of Python may take long, and each start makes
  /// many.
  void end_when(std::stop_token stop) { stop_ = std::move(stop); }

  int variables() const override { return ties_.variables() + 1; }
  int residuals() const override { return error_.residuals(); }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override;

  model::ExactDesign<double> design(const Eigen::VectorXd& x) const;
  /// Returns the state of the lattice's bodies, mm.
  model::State state(const Eigen::VectorXd& x) const;
  /// Computes the Jacobian by differences alone, for comparison with the gradient. @return false if a stop was
  /// requested, or the error has no finite value
  bool differences(const Eigen::VectorXd& x, Eigen::MatrixXd& J) const;
  /// Returns start k of a search. 0 is flat at the middle theta; 1 and 2 are bent evenly to either side. Later ones
  /// have random bends that change from one end to the other, and a random theta.
  Eigen::VectorXd start(int k, std::uint64_t seed) const;

 private:
  /// @return false if a stop was requested, or the error has no finite value
  bool error_at(const Eigen::VectorXd& x, Eigen::VectorXd& r) const;
  bool exact_jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& J) const;

  const CustomError& error_;
  optim::BendTies ties_;
  int rows_ = 1;
  double cell_mm_ = 1;
  Eigen::VectorXd lower_, upper_;  // rad
  std::stop_token stop_;
};

}  // namespace kinetix::python
