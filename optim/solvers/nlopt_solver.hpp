#pragma once

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Returns NLopt's number of a method, an nlopt::algorithm. @pre not ceres, which is not a method of NLopt
int nlopt_algorithm(SolverName name);

/// Problem: minimise f(x) subject to lower <= x <= upper, in units that the problem chooses. For costs with a
/// gradient but without residuals.
class ScalarProblem {
 public:
  virtual ~ScalarProblem() = default;

  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;
  /// Evaluates f. @param gradient filled unless null   @return false if f cannot be evaluated
  virtual bool evaluate(const Eigen::VectorXd& x, double& f, Eigen::VectorXd* gradient) = 0;
};

/// Result of a search, as SolveResult; x and cost in the units of the problem.
struct ScalarResult {
  Eigen::VectorXd x;
  double cost = 0;  ///< infinity when no point could be evaluated
  SolveStatus status = SolveStatus::failed;
  std::string why;
  int evaluations = 0;
  std::vector<std::pair<int, double>>
      history;  ///< (evaluations, best cost so far) whenever the best improved
};

/// Runs one of NLopt's gradient methods (slsqp, mma, ccsa) and records the best point itself. A point where f
/// cannot be evaluated gets a cost above all others. At the start, or after twenty of them, the search ends
/// with its best result: SolveStatus::cannot_evaluate. `target` of the options has no effect.
/// @throws InvalidInput for other methods and invalid options
ScalarResult solve(ScalarProblem& problem, const Eigen::VectorXd& start, const SolverOptions& options);

}  // namespace kinetix::optim
