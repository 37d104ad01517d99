#include "app/sweep/workers/work_queue.hpp"

#include <algorithm>

namespace kinetix::app {
namespace {

constexpr double wanted_seconds = 0.1;  // of a chunk: shorter ones queue, longer ones keep others waiting
constexpr double most_of_a_chunk = 1 << 16;  // of a chunk: its rows travel and are stored as one
constexpr double growth = 4;                // times the last chunk: one quick sample tells little of the next
constexpr std::size_t share_of_rest = 4;    // one of so many goes out at a time,
constexpr std::size_t least_of_rest = 256;  // but no fewer samples, if so many are wanted

}  // namespace

std::vector<std::int64_t> WorkQueue::take(std::size_t count) {
  std::vector<std::int64_t> samples;
  count = std::min(count, std::max((done_.size() - next_) / share_of_rest, least_of_rest));
  for (; next_ < done_.size() && samples.size() < count; ++next_)
    if (!done_[next_]) samples.push_back(static_cast<std::int64_t>(next_));
  return samples;
}

void ChunkSize::took(std::size_t samples, double seconds) {
  const double fitting = static_cast<double>(samples) * wanted_seconds / std::max(seconds, 1e-9);
  const double most = std::min(growth * static_cast<double>(samples), most_of_a_chunk);
  size_ = static_cast<std::size_t>(std::clamp(fitting, 1.0, most));
}

}  // namespace kinetix::app
