#pragma once

#include "app/sweep/evaluators/evaluator.hpp"
#include "app/sweep/workers/thread_pool.hpp"

namespace kinetix::app {

/// Runs samples in processes of their own, one at a time in each, until there are none left: for models that
/// keep global state. A sample whose process dies is a failed sample, and another process takes its place.
/// @param processes >= 1   @param make what each process computes samples with
/// @pre no other thread of this process allocates or writes while it forks: the console's does not
/// @throws what the source throws
void run_in_processes(const SweepPlan& plan, int processes, const WorkSource& source,
                      const EvaluatorMaker& make = make_evaluator);

}  // namespace kinetix::app
