#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::optim {

/// Cost with its derivatives by the readings.
struct WeighedReadings {
  double cost = 0;        ///< dimensionless, or the channel's unit squared: see PictureCost
  Eigen::VectorXd slope;  ///< derivative by each reading, per unit of the channel
};

/// Mismatch between the readings of a channel, one per cell, and a picture of given levels. Weighted least
/// squares split the readings into mean + slope * (level - mean level) + residual. In a picture of two levels
/// the letter and the rest have half of the weight each. Cells behind those with levels (the holes of a
/// panel) have no part in the cost: their slope is 0.
class PictureCost {
 public:
  /// @pre levels in [0, 1], not all the same
  explicit PictureCost(std::vector<double> levels);

  /// Returns the weighted mean square of the residuals when the slope is `separation`, in the channel's unit
  /// squared. Leads away from a start that shows nothing.
  WeighedReadings for_separation(const std::vector<double>& readings, double separation) const;
  /// Returns -2 log(d') of two levels: the log of the residuals' variance minus that of the squared slope.
  /// Infinite unless the slope is positive.
  WeighedReadings for_contrast(const std::vector<double>& readings) const;

 private:
  double mean(const std::vector<double>& readings) const;

  std::vector<double> weights_;  ///< they sum to 1
  std::vector<double> centred_;  ///< levels minus their mean
  double spread_ = 0;            ///< variance of the levels
};

}  // namespace kinetix::optim
