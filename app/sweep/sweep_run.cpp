#include "app/sweep/sweep_run.hpp"

#include <omp.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

#include "app/sweep/workers/process_pool.hpp"
#include "app/sweep/workers/work_queue.hpp"

namespace kinetix::app {
namespace {

/// Which samples need not be computed here.
std::vector<bool> done_or_others(const SweepTable& table, const Share& share) {
  std::vector<bool> done = table.done();
  for (std::size_t k = 0; k < done.size(); ++k)
    if (!share.has(static_cast<std::int64_t>(k))) done[k] = true;
  return done;
}

/// The queue and the table as a source for the threads and for the other ranks.
class Office {
 public:
  Office(SweepTable& table, const Share& share, const std::function<void()>& added)
      : table_(table), queue_(done_or_others(table, share)), added_(added) {}

  WorkSource source() {
    return {[this](std::size_t count) { return take(count); },
            [this](const std::vector<SampleRow>& rows) { give(rows); }};
  }

 private:
  std::vector<std::int64_t> take(std::size_t count) {
    const std::lock_guard lock(mutex_);
    return queue_.take(count);
  }

  void give(const std::vector<SampleRow>& rows) {
    const std::lock_guard lock(mutex_);
    try {
      table_.add(rows);
    } catch (...) {
      queue_.stop();
      throw;
    }
    added_();
  }

  SweepTable& table_;
  WorkQueue queue_;
  const std::function<void()>& added_;
  std::mutex mutex_;
};

/// Rank 0 works beside serving the others: MPI stays with main's thread.
void work_and_serve(const SweepPlan& plan, const Ranks& ranks, int threads, const WorkSource& source,
                    const std::function<void(const std::string&)>& notice) {
  std::exception_ptr own, others;
  std::thread worker([&] {
    try {
      run_on_threads(plan, threads, source);
    } catch (...) {
      own = std::current_exception();
    }
  });
  try {
    ranks.serve(source, notice);
  } catch (...) {
    others = std::current_exception();
  }
  worker.join();
  if (own) std::rethrow_exception(own);
  if (others) std::rethrow_exception(others);
}

/// What ranks that gave up had taken with them.
void compute_lost(const SweepPlan& plan, SweepTable& table, const Share& share, int threads,
                  const std::function<void()>& added) {
  if (table.count() >= share.size(plan.size())) return;
  Office office(table, share, added);
  run_on_threads(plan, threads, office.source());
}

}  // namespace

int threads_of(const SweepPlan& plan, const Ranks& ranks, int asked) {
  if (!plan.is_thread_safe() && ranks.size() > 1) return 1;
  if (asked > 0) return asked;
  const int cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
  return std::max(1, std::min(omp_get_max_threads(), cores) / ranks.on_this_machine());
}

void run_sweep(const SweepPlan& plan, SweepTable& table, const Share& share, const Ranks& ranks, int threads,
               const std::function<void()>& added, const std::function<void(const std::string&)>& notice) {
  Office office(table, share, added);
  const WorkSource source = office.source();
  const int used = threads_of(plan, ranks, threads);
  if (ranks.size() > 1) {
    work_and_serve(plan, ranks, used, source, notice);
    return compute_lost(plan, table, share, used, added);
  }
  if (plan.is_thread_safe()) return run_on_threads(plan, used, source);
  run_in_processes(plan, used, source);
}

}  // namespace kinetix::app
