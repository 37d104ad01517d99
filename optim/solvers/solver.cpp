#include "optim/solvers/solver.hpp"

#include <cmath>

#include "model/base/invalid_input.hpp"
#include "optim/solvers/best_so_far.hpp"

namespace kinetix::optim {

std::string to_string(SolverName name) {
  switch (name) {
    case SolverName::ceres:
      return "ceres";
    case SolverName::slsqp:
      return "slsqp";
    case SolverName::mma:
      return "mma";
    case SolverName::ccsa:
      return "ccsa";
    case SolverName::bobyqa:
      return "bobyqa";
    case SolverName::cobyla:
      return "cobyla";
    case SolverName::crs:
      return "crs";
  }
  return "?";
}

const std::vector<SolverName>& all_solvers() {
  static const std::vector<SolverName> names = {SolverName::ceres, SolverName::slsqp,  SolverName::mma,
                                                SolverName::ccsa,  SolverName::bobyqa, SolverName::cobyla,
                                                SolverName::crs};
  return names;
}

std::string description(SolverName name) {
  switch (name) {
    case SolverName::ceres:
      return "Ceres Levenberg-Marquardt, exact derivatives";
    case SolverName::slsqp:
      return "NLopt SLSQP, sequential quadratic programming, exact gradient";
    case SolverName::mma:
      return "NLopt MMA, moving asymptotes, exact gradient";
    case SolverName::ccsa:
      return "NLopt CCSAQ, conservative convex separable approximations, exact gradient";
    case SolverName::bobyqa:
      return "NLopt BOBYQA, quadratic models, derivative-free";
    case SolverName::cobyla:
      return "NLopt COBYLA, linear models, derivative-free";
    case SolverName::crs:
      return "NLopt CRS2, controlled random search, global, derivative-free";
  }
  return "?";
}

std::string to_string(SolveStatus status) {
  switch (status) {
    case SolveStatus::converged:
      return "converged";
    case SolveStatus::target_reached:
      return "target reached";
    case SolveStatus::stopped:
      return "stopped";
    case SolveStatus::evaluation_limit:
      return "evaluation limit";
    case SolveStatus::stalled:
      return "stalled";
    case SolveStatus::cannot_evaluate:
      return "cannot evaluate";
    case SolveStatus::failed:
      return "failed";
  }
  return "?";
}

void SolverOptions::validate() const {
  if (!(max_evaluations >= 1)) throw InvalidInput("max_evaluations must be at least 1");
  if (!(tolerance > 0 && tolerance < 1)) throw InvalidInput("tolerance must lie between 0 and 1");
  if (!(target >= 0) || !std::isfinite(target)) throw InvalidInput("target must be 0 or more, and finite");
}

SolveResult solve(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                  const SolverOptions& options) {
  options.validate();
  const Eigen::VectorXd inside = start.cwiseMax(problem.lower()).cwiseMin(problem.upper());
  return options.name == SolverName::ceres ? solve_with_ceres(problem, inside, options)
                                           : solve_with_nlopt(problem, inside, options);
}

}  // namespace kinetix::optim
