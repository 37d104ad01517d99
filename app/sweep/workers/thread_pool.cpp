#include "app/sweep/workers/thread_pool.hpp"

#include <exception>
#include <mutex>
#include <utility>

#include "app/run/stopwatch.hpp"
#include "app/sweep/evaluators/evaluator.hpp"
#include "app/sweep/workers/work_queue.hpp"
#include "model/base/parallel_runs.hpp"

namespace kinetix::app {
namespace {

/// A source for many threads: locked, and closed by the first exception.
class SharedSource {
 public:
  explicit SharedSource(const WorkSource& source) : source_(source) {}

  std::vector<std::int64_t> take(std::size_t count) noexcept {
    const std::lock_guard lock(mutex_);
    if (failure_) return {};
    try {
      return source_.take(count);
    } catch (...) {
      failure_ = std::current_exception();
      return {};
    }
  }

  void give(std::vector<SampleRow> rows) noexcept {
    const std::lock_guard lock(mutex_);
    if (failure_) return;
    try {
      source_.give(std::move(rows));
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  void fail(std::exception_ptr failure) noexcept {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const WorkSource& source_;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

void work(const SweepPlan& plan, SharedSource& source) noexcept {
  try {
    const auto evaluator = make_evaluator(plan);
    ChunkSize size;
    for (auto samples = source.take(size.next()); !samples.empty(); samples = source.take(size.next())) {
      Stopwatch watch;
      std::vector<SampleRow> rows;
      rows.reserve(samples.size());
      for (const std::int64_t sample : samples) rows.push_back(run_sample(plan, *evaluator, sample));
      size.took(samples.size(), watch.lap());
      source.give(std::move(rows));
    }
  } catch (...) {
    source.fail(std::current_exception());
  }
}

}  // namespace

void run_on_threads(const SweepPlan& plan, int threads, const WorkSource& source) {
  SharedSource shared(source);
  model::run_in_parallel(threads, threads, [&](int) { work(plan, shared); });
  shared.rethrow();
}

}  // namespace kinetix::app
