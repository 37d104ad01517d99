#include "optim/solvers/solver.hpp"

#include <fmt/format.h>
#include <nlopt.hpp>

#include "model/base/invalid_input.hpp"
#include "optim/solvers/best_so_far.hpp"
#include "optim/solvers/nlopt_solver.hpp"

namespace kinetix::optim {

namespace {

struct NamedSolver {
  SolverName name;
  const char *word, *description;
  int nlopt;  ///< its nlopt::algorithm
};

constexpr int none_of_nlopt = -1;  // marks a solver that is not a method of NLopt

// Properties of all solvers, in the order of the enum.
constexpr NamedSolver named_solvers[] = {
    {SolverName::ceres, "ceres", "Ceres Levenberg-Marquardt, exact derivatives", none_of_nlopt},
    {SolverName::slsqp, "slsqp", "NLopt SLSQP, sequential quadratic programming, exact gradient",
     nlopt::LD_SLSQP},
    {SolverName::mma, "mma", "NLopt MMA, moving asymptotes, exact gradient", nlopt::LD_MMA},
    {SolverName::ccsa, "ccsa", "NLopt CCSAQ, conservative convex separable approximations, exact gradient",
     nlopt::LD_CCSAQ},
    {SolverName::bobyqa, "bobyqa", "NLopt BOBYQA, quadratic models, derivative-free", nlopt::LN_BOBYQA},
    {SolverName::cobyla, "cobyla", "NLopt COBYLA, linear models, derivative-free", nlopt::LN_COBYLA},
    {SolverName::crs, "crs", "NLopt CRS2, controlled random search, global, derivative-free",
     nlopt::GN_CRS2_LM},
};

constexpr bool is_in_order() {
  int expected = 0;
  for (const NamedSolver& solver : named_solvers)
    if (static_cast<int>(solver.name) != expected++) return false;
  return true;
}
static_assert(is_in_order());

const NamedSolver& solver_of(SolverName name) { return named_solvers[static_cast<std::size_t>(name)]; }

}  // namespace

std::string to_string(SolverName name) { return solver_of(name).word; }

std::string description(SolverName name) { return solver_of(name).description; }

int nlopt_algorithm(SolverName name) { return solver_of(name).nlopt; }

const std::vector<SolverName>& all_solvers() {
  static const std::vector<SolverName> names = [] {
    std::vector<SolverName> all;
    for (const NamedSolver& solver : named_solvers) all.push_back(solver.name);
    return all;
  }();
  return names;
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
  if (!(trust_radius > 0))
    throw InvalidInput(fmt::format("trust_radius is {}, must be above 0", trust_radius));
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
