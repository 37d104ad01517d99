#pragma once

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// One group of residuals with its derivatives, in the units of the problem.
struct ResidualBlock {
  Eigen::VectorXd r;
  Eigen::MatrixXd by_shared;  ///< r.size() x shared variables
  Eigen::MatrixXd by_local;   ///< r.size() x the variables of its part; no columns in the last block
};

/// Least-squares problem: minimise |r(x)|^2 / 2 subject to lower <= x <= upper, where x = (shared variables,
/// those of part 0, of part 1, ...). No residual depends on the variables of two parts: J^T J has the shape
/// of an arrow.
class ArrowProblem {
 public:
  virtual ~ArrowProblem() = default;

  virtual int shared() const = 0;
  /// Returns the number of variables of each part.
  virtual const std::vector<int>& parts() const = 0;
  /// Returns the bounds of all variables; +-infinity for none.
  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;
  /// Returns the number of residuals of each part, then of those that depend on the shared variables alone.
  virtual const std::vector<int>& residuals() const = 0;

  /// Fills one block per part and a last one for the shared variables alone.
  /// @param with_derivatives whether to compute the derivatives   @return false if it cannot be evaluated
  virtual bool evaluate(const Eigen::VectorXd& x, bool with_derivatives,
                        std::vector<ResidualBlock>& blocks) const = 0;
};

/// All residuals stacked, and their Jacobian as one matrix, in the units of the problem.
struct StackedResiduals {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
};
StackedResiduals stacked(const ArrowProblem& problem, const std::vector<ResidualBlock>& blocks);

/// Solves by Levenberg-Marquardt (Ceres). The parts are eliminated first (Schur complement), so the work is
/// proportional to their number. Ceres' steps stall at active bounds. Variables pressed against their bounds
/// are therefore held there, and the search continues until no others are. The result is the best feasible
/// point evaluated, recorded here and not by Ceres.
/// @param options only max_evaluations and tolerance are used   @throws InvalidInput for invalid options
SolveResult solve(const ArrowProblem& problem, const Eigen::VectorXd& start, const SolverOptions& options);

}  // namespace kinetix::optim
