#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "app/sweep/evaluators/evaluator.hpp"
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

/// Hands out the samples that are not done yet, in order.
class WorkQueue {
 public:
  explicit WorkQueue(std::vector<bool> done) : done_(std::move(done)) {}

  /// The next `count`, none when all are out. Fewer towards the end, so that all workers end together.
  std::vector<std::int64_t> take(std::size_t count);
  /// Gives nothing any more.
  void stop() { next_ = done_.size(); }

 private:
  std::vector<bool> done_;
  std::size_t next_ = 0;
};

/// How many samples a worker should get at a time: so many that handing them out costs little, so few that
/// little is lost or waited for. Starts with one.
class ChunkSize {
 public:
  std::size_t next() const { return size_; }
  /// @param seconds that the last chunk took
  void took(std::size_t samples, double seconds);

 private:
  std::size_t size_ = 1;
};

}  // namespace kinetix::app
