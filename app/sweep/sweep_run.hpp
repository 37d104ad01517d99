#pragma once

#include "app/sweep/table/shares.hpp"
#include "app/sweep/workers/ranks.hpp"

namespace kinetix::app {

/// Computes the samples of a share that the table has not: on threads, in processes of their own where the model keeps
/// global state, and on the other ranks. The table is the same whatever does the work.
/// @param threads of this process; 0: the machine's cores, shared among its ranks
/// @param added hears after each batch that is on the disk
/// @throws what the table throws; the other ranks have left then
void run_sweep(const SweepPlan& plan, SweepTable& table, const Share& share, const Ranks& ranks, int threads,
               const std::function<void()>& added, const std::function<void(const std::string&)>& notice);

/// How many threads a rank uses.
int threads_of(const SweepPlan& plan, const Ranks& ranks, int asked);

}  // namespace kinetix::app
