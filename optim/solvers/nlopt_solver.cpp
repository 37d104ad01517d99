#include "optim/solvers/nlopt_solver.hpp"

#include <algorithm>
#include <nlopt.hpp>

#include "model/base/invalid_input.hpp"
#include "optim/solvers/best_so_far.hpp"

namespace kinetix::optim {
namespace {

/// Cost |r|^2 / 2 for NLopt. Some of its methods ignore the evaluation limit and hang on NaN, so this object
/// stops them by an exception.
struct Objective {
  BestSoFar& best;
  nlopt::opt& solver;
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  bool broke = false;

  double operator()(const std::vector<double>& at, std::vector<double>& gradient) {
    if (best.should_stop()) throw nlopt::forced_stop();
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(at.data(), at.size());
    if (!best.evaluate(x, r, gradient.empty() ? nullptr : &J)) {
      broke = true;
      throw nlopt::forced_stop();
    }
    if (!gradient.empty()) Eigen::Map<Eigen::VectorXd>(gradient.data(), gradient.size()) = J.transpose() * r;
    return r.squaredNorm() / 2;
  }

  static double call(const std::vector<double>& x, std::vector<double>& gradient, void* self) {
    return (*static_cast<Objective*>(self))(x, gradient);
  }
};

std::vector<double> values(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

/// Returns first steps that fit each variable's bounds: BOBYQA refuses steps longer than half of them.
std::vector<double> first_steps(const LeastSquaresProblem& problem) {
  const Eigen::VectorXd width = problem.upper() - problem.lower();
  return values((width / 4).cwiseMin(0.05));
}

/// Sets the bounds. The global method needs a finite box: one unit around the start for variables without
/// bounds.
void set_bounds(nlopt::opt& solver, const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                bool is_global) {
  Eigen::VectorXd lower = problem.lower(), upper = problem.upper();
  for (int k = 0; is_global && k < start.size(); ++k) {
    if (!std::isfinite(lower[k])) lower[k] = start[k] - 1;
    if (!std::isfinite(upper[k])) upper[k] = start[k] + 1;
  }
  solver.set_lower_bounds(values(lower));
  solver.set_upper_bounds(values(upper));
}

std::string words(nlopt::result result) {
  switch (result) {
    case nlopt::STOPVAL_REACHED:
      return "the cost reached the requested value";
    case nlopt::FTOL_REACHED:
      return "the cost stopped changing";
    case nlopt::XTOL_REACHED:
      return "the variables stopped changing";
    case nlopt::MAXEVAL_REACHED:
      return "evaluation limit";
    case nlopt::MAXTIME_REACHED:
      return "time limit";
    case nlopt::ROUNDOFF_LIMITED:
      return "rounding errors stopped the progress";
    default:
      return "success";
  }
}

SolveStatus status_of(nlopt::result result) {
  if (result == nlopt::MAXEVAL_REACHED || result == nlopt::MAXTIME_REACHED)
    return SolveStatus::evaluation_limit;
  return SolveStatus::converged;
}

}  // namespace

SolveResult solve_with_nlopt(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                             const SolverOptions& options) {
  BestSoFar best(problem, start, options);
  nlopt::opt solver(static_cast<nlopt::algorithm>(nlopt_algorithm(options.name)),
                    static_cast<unsigned>(start.size()));
  Objective objective{best, solver, {}, {}};
  try {
    // Unseeded, NLopt uses the time of day. Its generator belongs to the thread.
    nlopt::srand(options.seed);
    solver.set_min_objective(&Objective::call, &objective);
    set_bounds(solver, problem, start, options.name == SolverName::crs);
    solver.set_ftol_rel(options.tolerance);
    solver.set_xtol_rel(1e-13);
    solver.set_maxeval(options.max_evaluations);
    solver.set_initial_step(first_steps(problem));
    std::vector<double> x = values(start);
    double cost = 0;
    const nlopt::result result = solver.optimize(x, cost);
    return best.finish(status_of(result), words(result));
  } catch (const nlopt::forced_stop&) {
    if (objective.broke)
      return best.finish(SolveStatus::cannot_evaluate, "the problem cannot be evaluated there");
    return best.finish(SolveStatus::evaluation_limit, "evaluation limit");
  } catch (const nlopt::roundoff_limited&) {
    return best.finish(SolveStatus::stalled, "rounding errors stopped the progress");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return best.finish(SolveStatus::failed, error.what());
  }
}

namespace {

using Eigen::VectorXd;

// Points that cannot be evaluated: after this many a method does not recover.
constexpr int max_failures = 20;

/// Returns NLopt's method, if it uses gradients and bounds. @throws InvalidInput for other methods
nlopt::algorithm algorithm(SolverName name) {
  if (name != SolverName::slsqp && name != SolverName::mma && name != SolverName::ccsa)
    throw InvalidInput("solver " + to_string(name) + " cannot minimise this cost. Use mma, ccsa or slsqp");
  return static_cast<nlopt::algorithm>(nlopt_algorithm(name));
}

struct NloptSearch {
  ScalarProblem& problem;
  const SolverOptions& options;
  ScalarResult result;
  double highest = -std::numeric_limits<double>::infinity();
  int failures = 0;
  bool broke = false;

  double operator()(const std::vector<double>& at, std::vector<double>& gradient) {
    if (result.evaluations >= options.max_evaluations || has_stop_request()) throw nlopt::forced_stop();
    const VectorXd x = Eigen::Map<const VectorXd>(at.data(), at.size());
    double f = 0;
    VectorXd slope;
    ++result.evaluations;
    const bool fine =
        problem.evaluate(x, f, gradient.empty() ? nullptr : &slope) && std::isfinite(f) && slope.allFinite();
    if (!fine) return barrier(gradient);
    highest = std::max(highest, f);
    if (f < result.cost) {
      result.x = x;
      result.cost = f;
      result.history.emplace_back(result.evaluations, f);
    }
    if (!gradient.empty()) gradient = values(slope);
    return f;
  }

  /// Returns a cost for a point that cannot be evaluated: above all others, so that the method turns back.
  /// Without any other point, or after many failures, the search ends.
  double barrier(std::vector<double>& gradient) {
    broke = !std::isfinite(result.cost) || ++failures > max_failures;
    if (broke) throw nlopt::forced_stop();
    std::fill(gradient.begin(), gradient.end(), 0.0);
    return highest + 1 + std::abs(highest);
  }

  /// Returns whether to stop. The search needs at least one result first.
  bool has_stop_request() const { return options.stop.stop_requested() && std::isfinite(result.cost); }

  static double call(const std::vector<double>& x, std::vector<double>& gradient, void* self) {
    return (*static_cast<NloptSearch*>(self))(x, gradient);
  }

  ScalarResult finish(SolveStatus status, std::string why) {
    result.status = status;
    result.why = std::move(why);
    return std::move(result);
  }
};

}  // namespace

ScalarResult solve(ScalarProblem& problem, const VectorXd& start, const SolverOptions& options) {
  options.validate();
  nlopt::opt solver(algorithm(options.name), static_cast<unsigned>(start.size()));
  NloptSearch search{problem, options, {}};
  search.result.x = start;
  search.result.cost = std::numeric_limits<double>::infinity();
  try {
    solver.set_min_objective(&NloptSearch::call, &search);
    solver.set_lower_bounds(values(problem.lower()));
    solver.set_upper_bounds(values(problem.upper()));
    solver.set_ftol_rel(options.tolerance);
    solver.set_maxeval(options.max_evaluations);
    std::vector<double> x = values(start);
    double cost = 0;
    if (solver.optimize(x, cost) == nlopt::MAXEVAL_REACHED)
      return search.finish(SolveStatus::evaluation_limit, "evaluation limit");
    return search.finish(SolveStatus::converged, "the cost stopped changing");
  } catch (const nlopt::forced_stop&) {
    if (search.broke)
      return search.finish(SolveStatus::cannot_evaluate, "no equilibrium of the panel was found there");
    if (search.has_stop_request()) return search.finish(SolveStatus::stopped, "stopped");
    return search.finish(SolveStatus::evaluation_limit, "evaluation limit");
  } catch (const nlopt::roundoff_limited&) {
    return search.finish(SolveStatus::stalled, "rounding errors stopped the progress");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return search.finish(SolveStatus::failed, error.what());
  }
}

}  // namespace kinetix::optim
