#pragma once

#include <cstdint>
#include <vector>

namespace kinetix::optim {

/// Options of the bootstrap. It draws as many rows as there are, with replacement, and computes the figure
/// again. The interval is between quantiles of the resampled figures (percentile method; Efron, Tibshirani,
/// "An introduction to the bootstrap", 1993, ch. 13).
struct ConfidenceOptions {
  double level = 0.95;     ///< probability of the interval, 0 < level < 1
  int resamples = 400;     ///< 2 to 100 000
  std::uint64_t seed = 0;  ///< same seed, same intervals

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// A figure and its interval, all in the figure's unit. NaN if there were too few usable rows.
struct Estimate {
  double value, lower, upper;
};

/// Returns the value below which a share of the values is, interpolated linearly, in their unit.
/// @param sorted at least one, ascending, finite
/// @param share 0 to 1
double sample_quantile(const std::vector<double>& sorted, double share);

/// Returns a figure with its interval from its values on the resamples, in its unit. Values that are not
/// finite are ignored. @param level of ConfidenceOptions
Estimate percentile_estimate(double value, std::vector<double> resampled, double level);

/// Returns the row drawn at place `draw` of resample `resample`. @param rows 1 or more
std::uint64_t resampled_row(std::uint64_t seed, int resample, std::uint64_t draw, std::uint64_t rows);

}  // namespace kinetix::optim
