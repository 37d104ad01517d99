#include "optim/solvers/multi_start.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <new>

#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"

namespace kinetix::optim {
namespace {

SolveResult failure(const std::string& why) {
  SolveResult failed;
  failed.residual_norm = std::numeric_limits<double>::infinity();
  failed.why = why;
  return failed;
}

SolveResult run_one(const LeastSquaresProblem& problem, const StartMaker& make_start, int k,
                    const MultiStartOptions& options) {
  try {
    SolverOptions solver = options.solver;
    solver.seed = options.seed + static_cast<unsigned long>(k);
    return solve(problem, make_start(k, options.seed), solver);
  } catch (const std::bad_alloc&) {
    throw;  // a search with fewer starts would give another result
  } catch (const std::exception& error) {
    return failure(error.what());
  } catch (...) {
    return failure("an unknown exception");
  }
}

}  // namespace

void MultiStartOptions::validate() const {
  if (!(starts >= 1)) throw InvalidInput("starts must be at least 1");
  if (!(threads >= 0)) throw InvalidInput("threads must be 0 (all cores) or more");
  solver.validate();
}

MultiStartResult multi_start(const LeastSquaresProblem& problem, const StartMaker& make_start,
                             const MultiStartOptions& options) {
  options.validate();
  MultiStartResult result;
  result.runs.resize(options.starts);
  std::mutex report_mutex;
  int ended = 0;
  double least = std::numeric_limits<double>::infinity();
  model::run_in_parallel(options.starts, options.threads, [&](int k) {
    result.runs[k] = run_one(problem, make_start, k, options);
    if (!options.ended) return;
    const std::lock_guard lock(report_mutex);
    least = std::min(least, result.runs[k].residual_norm);
    options.ended(++ended, least);
  });
  for (int k = 1; k < options.starts; ++k)
    if (result.runs[k].residual_norm < result.best_run().residual_norm) result.best = k;
  return result;
}

}  // namespace kinetix::optim
