#include "app/sweep/workers/thread_pool.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <utility>

#include "app/run/run_options.hpp"
#include "model/base/parallel_runs.hpp"

namespace kinetix::app {
namespace {

/// Locks a source for many threads, and closes it after the first exception.
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

constexpr double wanted_seconds = 0.1;  // per chunk: shorter ones queue, longer ones keep others waiting
constexpr double max_chunk_samples = 1 << 16;  // samples per chunk: its rows are sent and stored as one
constexpr double growth = 4;                   // limit over the last chunk: one quick sample is weak evidence
constexpr std::size_t share_of_rest = 4;       // a call takes at most the rest divided by this,
constexpr std::size_t least_of_rest = 256;     // or this number of samples if that is more

}  // namespace

void run_on_threads(const SweepPlan& plan, int threads, const WorkSource& source) {
  SharedSource shared(source);
  model::run_in_parallel(threads, threads, [&](int) { work(plan, shared); });
  shared.rethrow();
}

std::vector<std::int64_t> WorkQueue::take(std::size_t count) {
  std::vector<std::int64_t> samples;
  count = std::min(count, std::max((done_.size() - next_) / share_of_rest, least_of_rest));
  for (; next_ < done_.size() && samples.size() < count; ++next_)
    if (!done_[next_]) samples.push_back(static_cast<std::int64_t>(next_));
  return samples;
}

void ChunkSize::took(std::size_t samples, double seconds) {
  const double fitting = static_cast<double>(samples) * wanted_seconds / std::max(seconds, 1e-9);
  const double most = std::min(growth * static_cast<double>(samples), max_chunk_samples);
  size_ = static_cast<std::size_t>(std::clamp(fitting, 1.0, most));
}

}  // namespace kinetix::app
