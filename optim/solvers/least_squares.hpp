#pragma once

#include <Eigen/Core>

namespace kinetix::optim {

/// Least-squares problem: minimise |r(x)|^2 / 2 subject to lower <= x <= upper. x and r are in units that the
/// problem chooses.
class LeastSquaresProblem {
 public:
  virtual ~LeastSquaresProblem() = default;

  virtual int variables() const = 0;
  virtual int residuals() const = 0;
  /// Returns the bounds; +-infinity for none.
  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;

  /// Fills r (sized residuals()) and, unless null, J (sized residuals() x variables()), dr/dx. Safe to call
  /// from several threads. @return false if the problem cannot be evaluated
  virtual bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const = 0;
};

}  // namespace kinetix::optim
