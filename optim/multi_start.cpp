#include "optim/multi_start.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

SolveResult failure(const std::string& why) {
  SolveResult failed;
  failed.residual_norm = std::numeric_limits<double>::infinity();
  failed.why = why;
  return failed;
}

SolveResult run_one(const LeastSquaresProblem& problem, const StartMaker& make_start, int k,
                    const MultiStartOptions& options) noexcept {
  try {
    SolverOptions solver = options.solver;
    solver.seed = options.seed + static_cast<unsigned long>(k);
    return solve(problem, make_start(k, options.seed), solver);
  } catch (const std::exception& error) {
    return failure(error.what());
  } catch (...) {
    return failure("an unknown exception");
  }
}

// OpenMP orders what comes before, in and after a parallel region, but the thread sanitizer cannot see that:
// the runtime is not instrumented. These say the same in the language's own terms, so that what it reports is
// real.
std::atomic<int> entered{0}, left{0};

void before_region() { entered.fetch_add(1, std::memory_order_release); }
void enter_region() { entered.load(std::memory_order_acquire); }
void leave_region() { left.fetch_add(1, std::memory_order_release); }
void after_region() { left.load(std::memory_order_acquire); }

/// Fills the slots in parallel. Not instrumented itself, for the variables that the compiler hands to the
/// threads; all that it calls is.
__attribute__((no_sanitize("thread"))) void fill(std::vector<SolveResult>& runs, int threads,
                                                 const std::function<void(int, SolveResult&)>& run) {
  const int count = static_cast<int>(runs.size());
  before_region();
#pragma omp parallel num_threads(threads)
  {
    enter_region();
#pragma omp for schedule(dynamic, 1) nowait
    for (int k = 0; k < count; ++k) run(k, runs[k]);
    leave_region();
  }
  after_region();
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
  const int allowed = options.threads > 0 ? options.threads : omp_get_max_threads();
  const int threads = std::min(allowed, options.starts);
  fill(result.runs, threads,
       [&](int k, SolveResult& slot) { slot = run_one(problem, make_start, k, options); });
  for (int k = 1; k < options.starts; ++k)
    if (result.runs[k].residual_norm < result.best_run().residual_norm) result.best = k;
  return result;
}

}  // namespace kinetix
