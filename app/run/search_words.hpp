#pragma once

#include <functional>
#include <string>

#include "app/run/run_options.hpp"
#include "optim/solvers/multi_start.hpp"

namespace kinetix::app {

/// Stop and progress of one search: at which evaluation it is, and how far off the best is so far.
/// @param mm of |r| = 1
void follow(const RunOptions& run, double mm, optim::SolverOptions& search);

/// Returns a search from many starts with the seed and threads of the run, its stop and its progress.
/// @param in_words of the least |r| so far
optim::MultiStartOptions followed(optim::MultiStartOptions search, const RunOptions& run,
                                  std::function<std::string(double least)> in_words);

}  // namespace kinetix::app
