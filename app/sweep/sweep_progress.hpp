#pragma once

#include <cstdint>

#include "app/console/console.hpp"
#include "app/console/time_left.hpp"
#include "app/run/stopwatch.hpp"

namespace kinetix::app {

/// The bar of a sweep: share done, samples a second, time left.
class SweepProgress {
 public:
  /// @param total samples of the sweep; @param before those that were there already
  SweepProgress(Console& console, std::int64_t total, std::int64_t before);

  /// @param count samples that are in the table now
  void show(std::int64_t count);

 private:
  Console& console_;
  std::int64_t total_, before_;
  Stopwatch since_shown_;
  TimeLeft left_;
  double seconds_ = 0, next_ = 0;
};

}  // namespace kinetix::app
