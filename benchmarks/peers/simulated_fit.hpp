#pragma once

#include "optim/curve/curve_fit.hpp"
#include "sim/physics_options.hpp"

namespace kinetix::bench {

/// Fit of a strip to a curve with a simulation in the loop. Every evaluation folds the strip in the engine and
/// measures the midline of the resulting state. Residuals are signed distances of the goal's samples from that
/// midline, aligned. They are one side of the shape_rms, and about as large; each is 1 if a run does not settle. x =
/// (bends, theta) of a CurveFit. Not thread-safe: the engine has global state.
class SimulatedFit final : public optim::LeastSquaresProblem {
 public:
  /// @param fit is kept by reference
  SimulatedFit(const optim::CurveFit& fit, const model::CellSize& size, const sim::PhysicsOptions& options);

  int variables() const override { return static_cast<int>(lower_.size()); }
  int residuals() const override { return residuals_; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd*) const override;

  int runs() const { return runs_; }

 private:
  const optim::CurveFit& fit_;
  const model::CellSize size_;
  const sim::PhysicsOptions options_;
  Eigen::VectorXd lower_, upper_;
  int residuals_ = 0;
  mutable int runs_ = 0;
};

}  // namespace kinetix::bench
