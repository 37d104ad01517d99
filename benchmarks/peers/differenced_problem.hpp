#pragma once

#include "optim/solvers/solver.hpp"

namespace kinetix::bench {

/// Least-squares problem whose Jacobian is not known. It is found by differences, with one evaluation per variable
/// (forward, backward at an upper bound) or two (central).
class DifferencedProblem final : public optim::LeastSquaresProblem {
 public:
  enum class Differences { forward, central };

  /// @param problem is kept by reference; @param step in the units of its variables, > 0
  DifferencedProblem(const optim::LeastSquaresProblem& problem, Differences differences, double step);

  int variables() const override { return problem_.variables(); }
  int residuals() const override { return problem_.residuals(); }
  const Eigen::VectorXd& lower() const override { return problem_.lower(); }
  const Eigen::VectorXd& upper() const override { return problem_.upper(); }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override;

 private:
  const optim::LeastSquaresProblem& problem_;
  const Differences differences_;
  const double step_;
};

}  // namespace kinetix::bench
