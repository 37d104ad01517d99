#include "optim/solvers/scalar_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <nlopt.hpp>

#include "model/base/invalid_input.hpp"
#include "optim/solvers/nlopt_algorithm.hpp"

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;

// Points that cannot be evaluated: after this many a method does not recover.
constexpr int most_failures = 20;

/// Returns NLopt's method, if it uses gradients and bounds. @throws InvalidInput for other methods
nlopt::algorithm algorithm(SolverName name) {
  if (name != SolverName::slsqp && name != SolverName::mma && name != SolverName::ccsa)
    throw InvalidInput("solver " + to_string(name) + " cannot minimise this cost; use mma, ccsa or slsqp");
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
    broke = !std::isfinite(result.cost) || ++failures > most_failures;
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
