#pragma once

#include <vector>

namespace kinetix::targets {

/// How well a channel, one value a cell, tells the cells of a picture from the rest (formats.md).
struct DisplayScore {
  double letter = 0, rest = 0;  ///< means of the channel, in its unit
  /// d', dimensionless: (letter - rest) / sqrt(mean of the two variances), a root of at least 1e-5; 0 where the means
  /// are equal.
  double contrast = 0;
  /// Probability that a cell of the letter has a higher value than one of the rest; ties count half.
  double auc = 0.5;

  /// In the unit of the channel.
  double separation() const { return letter - rest; }
};

/// Cells with a level of at least 0.5 are the letter's. Differences of 1e-5, in the channel's unit, count
/// as none: rounding makes no picture. NaN among the values gives NaN.
/// @pre as many values as levels, and both kinds of cells
DisplayScore display_score(const std::vector<double>& channel, const std::vector<double>& levels);

/// Spearman's rank correlation of channel and levels, ties by mean ranks, in [-1, 1]; 0 where one of them is
/// all the same. For pictures of grey levels.
double rank_correlation(const std::vector<double>& channel, const std::vector<double>& levels);

}  // namespace kinetix::targets
