#pragma once

#include <cstdint>
#include <vector>

namespace kinetix::optim {

/// How intervals are found: by the bootstrap, which draws as many rows as there are, with replacement, works
/// the figure out anew, and takes the quantiles of what comes out (percentile method; Efron, Tibshirani, "An
/// introduction to the bootstrap", 1993, ch. 13).
struct ConfidenceOptions {
  double level = 0.95;     ///< share of the interval, 0 < level < 1
  int resamples = 400;     ///< 2 to 100 000
  std::uint64_t seed = 0;  ///< same seed, same intervals

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// A figure and its interval, all in the figure's unit. NaN where too few rows could be used.
struct Estimate {
  double value, lower, upper;
};

/// Below which a share of the values lies, linear between them, in their unit.
/// @param sorted at least one, ascending, finite   @param share 0 to 1
double sample_quantile(const std::vector<double>& sorted, double share);

/// The interval of a figure from its values on the resamples, in its unit. Values that are not finite do not
/// count.
/// @param level of ConfidenceOptions
Estimate percentile_estimate(double value, std::vector<double> resampled, double level);

/// Which row stands at place `draw` of resample `resample`. @param rows 1 or more
std::uint64_t resampled_row(std::uint64_t seed, int resample, std::uint64_t draw, std::uint64_t rows);

}  // namespace kinetix::optim
