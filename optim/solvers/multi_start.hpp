#pragma once

#include <cstdint>

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

struct MultiStartOptions {
  int starts = 8;   ///< >= 1
  int threads = 0;  ///< >= 0; 0 = all cores. At most one per start is used
  std::uint64_t seed = 0;
  SolverOptions solver;
  /// Called after each start with the number of ended starts and the least |r| so far; one call
  /// at a time.
  std::function<void(int ended, double least)> ended = {};

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// Searches of one problem, in the order of their starts. A start that throws is a failed run without x. Lack
/// of memory ends them all.
struct MultiStartResult {
  std::vector<SolveResult> runs;
  int best = 0;  ///< index of the run with the least |r|; the first of equals

  const SolveResult& best_run() const { return runs[best]; }
};

/// Makes start k of a search; must depend on (k, seed) only.
using StartMaker = std::function<Eigen::VectorXd(int k, std::uint64_t seed)>;

/// Solves from every start, in parallel over starts. The same seed gives the same result for any number of
/// threads: each run writes its own slot and the best is chosen in order.
/// @throws InvalidInput for invalid options; std::bad_alloc of a start
MultiStartResult multi_start(const LeastSquaresProblem& problem, const StartMaker& make_start,
                             const MultiStartOptions& options);

}  // namespace kinetix::optim
