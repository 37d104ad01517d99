#pragma once

#include <functional>

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Minimise f(x) subject to lower <= x <= upper, in units that the problem chooses. For costs that have a
/// gradient but no residuals of their own.
class ScalarProblem {
 public:
  virtual ~ScalarProblem() = default;

  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;
  /// @param gradient filled unless null. @return false where f cannot be evaluated
  virtual bool evaluate(const Eigen::VectorXd& x, double& f, Eigen::VectorXd* gradient) = 0;
};

/// As SolveResult; x and cost in the units of the problem.
struct ScalarResult {
  Eigen::VectorXd x;
  double cost = 0;  ///< infinity when no point could be evaluated
  SolveStatus status = SolveStatus::failed;
  std::string why;
  int evaluations = 0;
  std::vector<std::pair<int, double>>
      history;  ///< (evaluations, best cost so far) whenever the best improved
};

/// Runs one of NLopt's gradient methods (slsqp, mma, ccsa) on our own book of the best point. A point where f
/// cannot be evaluated is shown to the method as a high wall; at the start, or after twenty of them, the
/// search ends with what it has: SolveStatus::cannot_evaluate. `target` of the options does not count.
/// @throws InvalidInput for other methods and options that do not validate
ScalarResult solve(ScalarProblem& problem, const Eigen::VectorXd& start, const SolverOptions& options);

}  // namespace kinetix::optim
