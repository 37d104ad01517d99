#pragma once

#include <functional>

namespace kinetix::model {

/// How many threads that is. @param asked 0 = all cores
int threads_of(int asked);

/// Calls run(k) for every k from 0 to count - 1, on several threads and in any order. For the same answer
/// whatever their number, each run writes a slot of its own.
/// @param threads 0 = all cores; never more than there are runs
/// @throws what the run of least k threw, once all have ended
void run_in_parallel(int count, int threads, const std::function<void(int)>& run);

}  // namespace kinetix::model
