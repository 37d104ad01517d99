#pragma once

#include <cstdint>
#include <functional>

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

struct MultiStartOptions {
  int starts = 8;   ///< >= 1
  int threads = 0;  ///< >= 0; 0 = all cores. Never more than there are starts
  std::uint64_t seed = 0;
  SolverOptions solver;
  /// Hears after each start how many have ended, and the least |r| so far; one call at a time.
  std::function<void(int ended, double least)> ended = {};

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// All searches of one problem, in the order of their starts. A start that throws is a failed run without x, but
/// for one that gets no memory, which ends them all.
struct MultiStartResult {
  std::vector<SolveResult> runs;
  int best = 0;  ///< index of the run with the least |r|; the first of equals

  const SolveResult& best_run() const { return runs[best]; }
};

/// Makes start k of a search; must depend on (k, seed) alone.
using StartMaker = std::function<Eigen::VectorXd(int k, std::uint64_t seed)>;

/// Solves from every start, in parallel over starts. Same seed, same answer, for any number of threads: each
/// run writes its own slot and the best is chosen in order. @throws InvalidInput for options that do not
/// validate; std::bad_alloc of a start
MultiStartResult multi_start(const LeastSquaresProblem& problem, const StartMaker& make_start,
                             const MultiStartOptions& options);

}  // namespace kinetix::optim
