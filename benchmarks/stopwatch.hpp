#pragma once

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace kinetix::bench {

/// Seconds that f takes, once.
template <class F>
double seconds(const F& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// @pre values is not empty
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median over repeats of the seconds per call, each repeat averaging `calls` calls.
template <class F>
double median_seconds(int repeats, int calls, const F& f) {
  std::vector<double> samples;
  for (int r = 0; r < repeats; ++r) {
    samples.push_back(seconds([&] {
                        for (int c = 0; c < calls; ++c) f();
                      }) /
                      calls);
  }
  return median(std::move(samples));
}

}  // namespace kinetix::bench
