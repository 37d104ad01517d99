#pragma once

#include <cstdint>
#include <vector>

namespace kinetix::app {

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
