#pragma once

#include <functional>

namespace kinetix::model {

/// The number of threads to use: all cores for 0, otherwise as requested.
/// @throws InvalidInput unless requested is 0 to 1024
int threads_of(int requested);

/// Calls run(k) for every k from 0 to count - 1, on several threads and in any order. For the same answer
/// whatever their number, each run writes a slot of its own.
/// @param threads 0 = all cores; never more than there are runs
/// @throws what the run of least k threw, once all have ended
void run_in_parallel(int count, int threads, const std::function<void(int)>& run);

}  // namespace kinetix::model
