#pragma once

#include <Eigen/Core>

namespace kinetix::optim {

/// Minimise |r(x)|^2 / 2 subject to lower <= x <= upper. What every solver here solves. x and r
/// in units that the problem chooses.
class LeastSquaresProblem {
 public:
  virtual ~LeastSquaresProblem() = default;

  virtual int variables() const = 0;
  virtual int residuals() const = 0;
  /// Bounds; +-infinity where there is none.
  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;

  /// Fills r (sized residuals()) and, unless null, J (sized residuals() x variables()), dr/dx. Safe to call
  /// from several threads. @return false where the problem cannot be evaluated
  virtual bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const = 0;
};

}  // namespace kinetix::optim
