#pragma once

#include <Eigen/Core>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "optim/solvers/least_squares.hpp"

namespace kinetix::optim {

enum class SolverName { ceres, slsqp, mma, ccsa, bobyqa, cobyla, crs };

/// "ceres", "slsqp", ...
std::string to_string(SolverName name);
/// All of them, in the order of the enum.
const std::vector<SolverName>& all_solvers();
/// One line for a person: what kind of method it is.
std::string description(SolverName name);

struct SolverOptions {
  SolverName name = SolverName::ceres;
  int max_evaluations = 500;  ///< of the residual, >= 1
  double tolerance = 1e-5;    ///< relative change of the cost at which a search may stop, (0, 1)
  unsigned long seed = 0;     ///< of the methods that draw random points
  std::stop_token stop = {};  ///< where it asks to, the search ends with the best so far
  /// Ceres: how long the first steps may be, in units of its scaled variables (dimensionless), > 0: 1e8 takes whole Gauss-Newton steps, less keeps near a start where the
  /// residuals leave much open.
  double trust_radius = 1e8;
  double target = 0;  ///< stop as soon as |r| is at most this, in units of the problem, >= 0 and finite

  /// Hears of every evaluation: how many there were, and the least |r| so far. On the thread of the search.
  std::function<void(int evaluations, double least)> heard = {};

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

enum class SolveStatus {
  converged,
  target_reached,
  evaluation_limit,
  stopped,          ///< from outside
  stalled,          ///< rounding errors stopped the progress
  cannot_evaluate,  ///< the problem has no finite value where the solver needs one
  failed,           ///< the solver refused the problem, or the problem threw
};

/// "converged", "evaluation limit", ...
std::string to_string(SolveStatus status);

/// One search from one start. `x` is the best feasible point that was evaluated, by our own book: what a
/// solver returns may be infeasible or worse. All in the units of the problem.
struct SolveResult {
  Eigen::VectorXd x;
  double residual_norm = 0;  ///< |r(x)|; infinity when no point could be evaluated
  SolveStatus status = SolveStatus::failed;
  std::string why;  ///< the solver's own reason in words
  int evaluations = 0;
  /// (evaluations, best |r| so far) whenever the best improved
  std::vector<std::pair<int, double>> history;
};

/// Runs one solver. Not converging is a status, not an exception; no exception leaves a solver callback.
/// @throws InvalidInput for options that do not validate
SolveResult solve(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                  const SolverOptions& options);

}  // namespace kinetix::optim
