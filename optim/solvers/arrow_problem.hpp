#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::optim {

/// One group of residuals with its derivatives, in the units of the problem.
struct ResidualBlock {
  Eigen::VectorXd r;
  Eigen::MatrixXd by_shared;  ///< r.size() x shared variables
  Eigen::MatrixXd by_own;     ///< r.size() x the variables of its part; no columns in the last block
};

/// Minimise |r(x)|^2 / 2 subject to lower <= x <= upper, where x = (shared variables, those of part 0, of
/// part 1, ...) and no residual knows the variables of two parts: J^T J has the shape of an arrow.
class ArrowProblem {
 public:
  virtual ~ArrowProblem() = default;

  virtual int shared() const = 0;
  /// Number of variables of each part.
  virtual const std::vector<int>& parts() const = 0;
  /// Bounds of all variables; +-infinity where there is none.
  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;
  /// Number of residuals of each part, and last of those of the shared variables alone.
  virtual const std::vector<int>& residuals() const = 0;

  /// Fills one block a part and a last one for the shared variables alone.
  /// @param with_derivatives whether the derivatives are asked for  @return false where it cannot be evaluated
  virtual bool evaluate(const Eigen::VectorXd& x, bool with_derivatives,
                        std::vector<ResidualBlock>& blocks) const = 0;
};

/// All residuals under each other, and their Jacobian as one matrix, in the units of the problem.
struct StackedResiduals {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
};
StackedResiduals stacked(const ArrowProblem& problem, const std::vector<ResidualBlock>& blocks);

}  // namespace kinetix::optim
