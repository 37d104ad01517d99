#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::optim {

/// What prints with errors show of a picture of two levels.
struct AsMadeDisplay {
  double contrast = 0;      ///< d' of the mean square scatter of cells over prints, dimensionless
  double contrast_p05 = 0;  ///< 5th percentile: what 95 of 100 prints exceed, dimensionless
  double auc = 0;           ///< over prints, [0, 1]
};

/// To first order in the errors: readings are normal, with the covariance R R^T about those of the design. Scatter
/// widens the letter's readings and those of the rest, so that the expected contrast is below that of the design.
/// @param readings of the design, one a cell   @param levels of the same cells, those of at least 0.5 the letter's
/// @param derivatives R: a row a cell, its reading by each error, one standard deviation each. The unit of the readings
/// @pre both kinds of cells, two of each or more
AsMadeDisplay as_made_display(const std::vector<double>& readings, const std::vector<double>& levels,
                              const Eigen::MatrixXd& derivatives);

}  // namespace kinetix::optim
