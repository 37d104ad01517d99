#pragma once

#include "app/run/run_options.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::app {

/// Stop and progress of one search: at which evaluation it is, and how far off the best is so far.
/// @param mm of |r| = 1
void follow(const RunOptions& run, double mm, optim::SolverOptions& search);

}  // namespace kinetix::app
