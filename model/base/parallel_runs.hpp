#pragma once

#include <functional>

namespace kinetix::model {

/// Returns the number of threads to use: all cores for 0, otherwise as requested.
/// @throws InvalidInput unless requested is 0 to 1024
int threads_of(int requested);

/// Calls run(k) for every k from 0 to count - 1, on several threads and in any order. Each run must write to
/// a separate slot, so that the result does not depend on the number of threads.
/// @param threads 0 = all cores; never more than there are runs
/// @throws the exception of the run with the least k, after all runs have ended
void run_in_parallel(int count, int threads, const std::function<void(int)>& run);

}  // namespace kinetix::model
