#pragma once

#include <vector>

namespace kinetix::targets {

/// Separation of the letter of a picture from the rest by a channel with one value per cell (formats.md).
struct DisplayScore {
  double letter = 0, rest = 0;  ///< means of the channel, in its unit
  /// d', dimensionless: (letter - rest) / sqrt(mean of the two variances). The root is at least 1e-5. Equal means give
  /// 0.
  double contrast = 0;
  /// Probability that a cell of the letter has a higher value than one of the rest; ties count half.
  double auc = 0.5;

  /// In the unit of the channel.
  double separation() const { return letter - rest; }
};

/// Scores a channel. Cells with a level of at least 0.5 belong to the letter. Differences of 1e-5, in the channel's
/// unit, count as none, since rounding makes no picture. NaN among the values gives NaN.
/// @pre as many values as levels, and both kinds of cells
DisplayScore display_score(const std::vector<double>& channel, const std::vector<double>& levels);

/// Computes Spearman's rank correlation of channel and levels, ties by mean ranks, in [-1, 1]. The result is 0 if all
/// values of one of them are equal. For pictures of grey levels.
double rank_correlation(const std::vector<double>& channel, const std::vector<double>& levels);

}  // namespace kinetix::targets
