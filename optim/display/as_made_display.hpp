#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::optim {

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
DisplayTolerance as_made_display(const std::vector<double>& readings, const std::vector<double>& levels,
                                 const Eigen::MatrixXd& derivatives);

}  // namespace kinetix::optim
