#pragma once

#include <algorithm>
#include <vector>

#include "benchmarks/speed_error/measured_point.hpp"
#include "benchmarks/stopwatch.hpp"

namespace kinetix::bench {

inline constexpr int most_repeats = 5;  ///< runs: a median that one disturbed run does not move
/// s of all runs together: long runs vary less, and one suffices.
inline constexpr double enough_seconds = 0.3;

/// Repeats a run up to five times, fewer if that would take longer than 0.3 s. Takes the median of the times that the
/// runs report. @param run returns its seconds
template <class Run>
void time_runs(const Run& run, MeasuredPoint& point) {
  std::vector<double> samples;
  double all = 0;
  do {
    samples.push_back(run());
    all += samples.back();
  } while (static_cast<int>(samples.size()) < most_repeats && all + samples.back() < enough_seconds);
  const auto [shortest, longest] = std::minmax_element(samples.begin(), samples.end());
  point.seconds = median(samples);
  point.spread = (*longest - *shortest) / point.seconds;
}

}  // namespace kinetix::bench
