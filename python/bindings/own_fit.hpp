#pragma once

#include <stop_token>

#include "model/lattice/square/family/exact_family.hpp"
#include "optim/curve/bend_ties.hpp"
#include "optim/solvers/least_squares.hpp"
#include "python/bindings/own_error.hpp"

namespace kinetix::python {

/// Fit of a strip (family F2) to an error of one's own. x = (bends of optim/curve/bend_ties.hpp, theta), rad. With the
/// gradient of the error the Jacobian is exact; without, central differences over x.
class OwnFit final : public optim::LeastSquaresProblem {
 public:
  /// @param cell_mm cell edge   @param theta bounds, rad. The error is kept by reference; it was called once
  OwnFit(const OwnError& error, optim::BendTies ties, int rows, double cell_mm, optim::AngleRange theta);

  /// Where it asks to, nothing is evaluated any more: a call of Python may take long, and each start makes many.
  void end_when(std::stop_token stop) { stop_ = std::move(stop); }

  int variables() const override { return ties_.variables() + 1; }
  int residuals() const override { return error_.residuals(); }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override;

  model::ExactDesign<double> design(const Eigen::VectorXd& x) const;
  /// The lattice's bodies, mm.
  model::State state(const Eigen::VectorXd& x) const;
  /// By differences alone, to compare with the gradient. @return false where the error has no finite value
  bool differences(const Eigen::VectorXd& x, Eigen::MatrixXd& J) const;
  /// Start k of a search: 0 flat at the middle theta; 1 and 2 bent evenly to either side; then random bends that turn
  /// from one end to the other, and theta.
  Eigen::VectorXd start(int k, std::uint64_t seed) const;

 private:
  /// @return false where told to end, or the error has no finite value
  bool error_at(const Eigen::VectorXd& x, Eigen::VectorXd& r) const;
  bool exact_jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& J) const;

  const OwnError& error_;
  optim::BendTies ties_;
  int rows_ = 1;
  double cell_mm_ = 1;
  Eigen::VectorXd lower_, upper_;  // rad
  std::stop_token stop_;
};

}  // namespace kinetix::python
