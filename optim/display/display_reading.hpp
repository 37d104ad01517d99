#pragma once

#include "model/opening/blurred_light.hpp"
#include "model/opening/cell_opening.hpp"

namespace kinetix::optim {

/// Quantity by which a display is read: one number per cell (formats.md).
enum class Channel {
  light,     ///< through the panel, blurred over half a cell edge (model::BlurredLight), 0 to 1
  aperture,  ///< largest inscribed circle of the opening, diameter in cell edges
  area,      ///< area of the opening, cell edges squared
  rotation,  ///< mean turn of the cell's bodies, each in its sense in a basic sheet, rad
};

std::string to_string(Channel channel);

/// Returns the readings of all cells by definition, in the order of panel.cells and in the unit of Channel.
std::vector<double> channel_values(Channel channel, const model::Linkage& panel, const model::State& state);

/// Smooth substitute with derivatives. Only the aperture differs from channel_values(): it is
/// soft_aperture().
class SmoothChannel {
 public:
  /// Keeps the references.
  SmoothChannel(Channel channel, const model::Linkage& panel, const model::State& state);

  const std::vector<double>& values() const { return values_; }
  /// Adds the derivatives of a function of the values.
  /// @param by_value derivative of the function by each value
  void add_gradient(const Eigen::VectorXd& by_value, model::PanelGradient& gradient) const;

 private:
  const model::Linkage& panel_;
  std::optional<model::BlurredLight> light_;
  std::vector<model::CellReading> readings_;  ///< of channels that depend on each cell alone
  std::vector<double> values_;
};

/// Cost with its derivatives by the readings.
struct WeightedReadings {
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
  WeightedReadings for_separation(const std::vector<double>& readings, double separation) const;
  /// Returns -2 log(d') of two levels: the log of the residuals' variance minus that of the squared slope.
  /// Infinite unless the slope is positive.
  WeightedReadings for_contrast(const std::vector<double>& readings) const;

 private:
  double mean(const std::vector<double>& readings) const;

  std::vector<double> weights_;  ///< they sum to 1
  std::vector<double> centred_;  ///< levels minus their mean
  double spread_ = 0;            ///< variance of the levels
};

/// Readability of a two-level picture on prints with errors.
struct DisplayTolerance {
  double contrast = 0;      ///< d' with the mean square scatter of cells over prints, dimensionless
  double contrast_p05 = 0;  ///< 5th percentile: 95 of 100 prints exceed it, dimensionless
  double auc = 0;           ///< expected value over prints, [0, 1]
};

/// Computes the readability to first order in the errors. Readings are normal with covariance R R^T about
/// those of the design. The scatter widens the readings of the letter and of the rest, so the expected
/// contrast is below the design's.
/// @param readings of the design, one per cell.
/// @param levels of the same cells; cells of at least 0.5 are the letter.
/// @param derivatives R, in the unit of the readings: a row per cell with the derivatives by each error, per
/// standard deviation.
/// @pre at least two cells of each kind
DisplayTolerance analyse_display_tolerance(const std::vector<double>& readings,
                                           const std::vector<double>& levels,
                                           const Eigen::MatrixXd& derivatives);

}  // namespace kinetix::optim
