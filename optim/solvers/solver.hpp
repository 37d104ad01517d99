#pragma once

#include <Eigen/Core>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace kinetix::optim {

/// Sharing of variables between hinges: one variable per column, row, ...
enum class Per { column, row, cell, hinge, all };

/// Symmetry of the folded shape under a motion of the flat sheet onto itself.
enum class Symmetry { none, mirror_x, mirror_y, rotate_2, rotate_4 };

/// Closed interval of an angle, rad.
struct AngleRange {
  double lower = 0, upper = 0;
};

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

enum class SolverName { ceres, slsqp, mma, ccsa, bobyqa, cobyla, crs };

/// Returns "ceres", "slsqp", ...
std::string to_string(SolverName name);
/// Returns all solvers, in the order of the enum.
const std::vector<SolverName>& all_solvers();
/// Describes the kind of method in one line for users.
std::string description(SolverName name);

struct SolverOptions {
  SolverName name = SolverName::ceres;
  int max_evaluations = 500;  ///< of the residuals, >= 1
  double tolerance = 1e-5;    ///< relative change of the cost at which a search may stop, (0, 1)
  unsigned long seed = 0;     ///< for methods that draw random points
  std::stop_token stop = {};  ///< on request, the search ends with the best so far
  /// Ceres: largest first steps, in units of its scaled variables (dimensionless), > 0. 1e8 allows whole
  /// Gauss-Newton steps. Smaller values stay near a start when the residuals leave much undetermined.
  double trust_radius = 1e8;
  double target = 0;  ///< stop as soon as |r| is at most this, in units of the problem, >= 0 and finite

  /// Called after every evaluation with their number and the least |r| so far, on the thread of the search.
  std::function<void(int evaluations, double least)> on_progress = {};

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

enum class SolveStatus {
  converged,
  target_reached,
  evaluation_limit,
  stopped,          ///< on request from outside
  stalled,          ///< rounding errors stopped the progress
  cannot_evaluate,  ///< the problem has no finite value where the solver needs one
  failed,           ///< the solver refused the problem, or the problem threw
};

/// Returns "converged", "evaluation limit", ...
std::string to_string(SolveStatus status);

/// Result of one search from one start. `x` is the best feasible point evaluated, recorded here: a solver may
/// return an infeasible or worse one. All in the units of the problem.
struct SolveResult {
  Eigen::VectorXd x;
  double residual_norm = 0;  ///< |r(x)|; infinity when no point could be evaluated
  SolveStatus status = SolveStatus::failed;
  std::string why;  ///< the solver's reason in words
  int evaluations = 0;
  /// (evaluations, best |r| so far) whenever the best improved
  std::vector<std::pair<int, double>> history;
};

/// Runs one solver. Failure to converge is a status and not an exception. No exception leaves a solver
/// callback.
/// @throws InvalidInput for invalid options
SolveResult solve(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                  const SolverOptions& options);

}  // namespace kinetix::optim
