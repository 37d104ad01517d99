#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "app/sweep/evaluators/evaluator.hpp"
#include "app/sweep/plan/sweep_plan.hpp"

namespace kinetix::app {

/// Source of samples and sink of rows for workers. Called by one thread at a time.
struct WorkSource {
  std::function<std::vector<std::int64_t>(std::size_t count)> take;  ///< empty: the work is done
  std::function<void(std::vector<SampleRow>)> give;                  ///< may throw: then all workers stop
};

/// Runs all samples on several threads (OpenMP). Rows do not depend on the number of threads.
/// @param threads >= 1
/// @throws exceptions of `give`
void run_on_threads(const SweepPlan& plan, int threads, const WorkSource& source);

/// Hands out the samples that are not done yet, in order.
class WorkQueue {
 public:
  explicit WorkQueue(std::vector<bool> done) : done_(std::move(done)) {}

  /// Returns the next samples, at most `count`; empty when all are handed out. Returns fewer towards the end
  /// to balance the workers.
  std::vector<std::int64_t> take(std::size_t count);
  /// Ends the queue: take() returns nothing after this.
  void stop() { next_ = done_.size(); }

 private:
  std::vector<bool> done_;
  std::size_t next_ = 0;
};

/// Computes the number of samples for a worker's next chunk. Large chunks cost little overhead; small ones
/// limit losses and waiting. Starts with one.
class ChunkSize {
 public:
  std::size_t next() const { return size_; }
  /// @param seconds duration of the last chunk
  void took(std::size_t samples, double seconds);

 private:
  std::size_t size_ = 1;
};

}  // namespace kinetix::app
