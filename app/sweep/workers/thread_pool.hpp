#pragma once

#include <functional>

#include "app/sweep/evaluators/sample_row.hpp"
#include "app/sweep/plan/sweep_plan.hpp"

namespace kinetix::app {

/// Where workers get samples and leave rows. Called by one thread at a time.
struct WorkSource {
  std::function<std::vector<std::int64_t>(std::size_t count)> take;  ///< none: the work is done
  std::function<void(std::vector<SampleRow>)> give;                  ///< may throw: then all stop
};

/// Runs samples on several threads (OpenMP) until there are none left. Rows do not depend on the number of
/// threads. @param threads >= 1
/// @throws what `give` throws
void run_on_threads(const SweepPlan& plan, int threads, const WorkSource& source);

}  // namespace kinetix::app
