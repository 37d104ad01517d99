#pragma once

#include "app/sweep/evaluators/evaluator.hpp"
#include "app/sweep/workers/thread_pool.hpp"

namespace kinetix::app {

/// Runs all samples in separate processes, one at a time in each, for models that keep global state. If a
/// process dies, its sample fails and another process replaces it.
/// @param processes >= 1   @param make makes the evaluator of each process.
/// @pre no other thread of this process allocates or writes during a fork; the console's thread does not.
/// @throws exceptions of the source
void run_in_processes(const SweepPlan& plan, int processes, const WorkSource& source,
                      const EvaluatorMaker& make = make_evaluator);

}  // namespace kinetix::app
