#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::optim {

/// A cost with its derivatives by what it depends on.
struct WeighedReadings {
  double cost = 0;        ///< dimensionless, or the channel's unit squared: see PictureCost
  Eigen::VectorXd slope;  ///< derivative by each reading, per unit of the channel
};

/// How badly the readings of a channel, one a cell, show a picture of given levels. Readings are split into
/// mean + slope * (level - mean level) + residual by least squares with the weights of the cells, half of all
/// to the letter and half to the rest in a picture of two levels. Cells after those that have levels, the holes of a
/// panel, have no part in it: their slope is 0.
class PictureCost {
 public:
  /// @pre levels in [0, 1], not all the same
  explicit PictureCost(std::vector<double> levels);

  /// Squares of the residuals that are left where the slope is `separation`, both in the channel's unit,
  /// squared: leads away from a start that shows nothing.
  WeighedReadings for_separation(const std::vector<double>& readings, double separation) const;
  /// -2 log(d') of two levels: log of the residuals' variance less twice that of the slope. Infinite unless
  /// the slope is positive.
  WeighedReadings for_contrast(const std::vector<double>& readings) const;

 private:
  double mean(const std::vector<double>& readings) const;

  std::vector<double> weights_;  ///< they sum to 1
  std::vector<double> centred_;  ///< levels less their mean
  double spread_ = 0;            ///< variance of the levels
};

}  // namespace kinetix::optim
