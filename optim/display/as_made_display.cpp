#include "optim/display/as_made_display.hpp"

#include <cmath>

#include "model/tolerance/as_made.hpp"

namespace kinetix::optim {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Cells of the letter or of the rest: their mean, and the variance about it.
struct Group {
  std::vector<Eigen::Index> cells;
  double mean = 0;      ///< of the design
  double variance = 0;  ///< expected over prints
  double variance_of_variance = 0;
  VectorXd mean_gradient;  ///< of the mean by each error
};

Group group(const std::vector<double>& readings, const std::vector<double>& levels,
            const MatrixXd& derivatives, bool letter) {
  Group g;
  for (std::size_t k = 0; k < levels.size(); ++k)
    if ((levels[k] >= 0.5) == letter) g.cells.push_back(static_cast<Eigen::Index>(k));
  const auto count = static_cast<double>(g.cells.size());
  MatrixXd own(g.cells.size(), derivatives.cols());
  VectorXd values(g.cells.size());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    own.row(k) = derivatives.row(g.cells[k]);
    values[k] = readings[g.cells[k]];
  }
  g.mean = values.mean();
  g.mean_gradient = own.colwise().mean();
  own.rowwise() -= g.mean_gradient.transpose();
  values.array() -= g.mean;
  // Variance of the quadratic form |values + own e|^2 / count in normal e.
  const MatrixXd covariance = own * own.transpose();
  g.variance = (values.squaredNorm() + covariance.trace()) / count;
  g.variance_of_variance =
      (2 * covariance.squaredNorm() + 4 * (own.transpose() * values).squaredNorm()) / (count * count);
  return g;
}

/// Returns the mean over all pairs of the probability that the letter's cell reads more.
double expected_auc(const std::vector<double>& readings, const Group& letter, const Group& rest,
                    const MatrixXd& derivatives) {
  double sum = 0;
  for (const Eigen::Index a : letter.cells)
    for (const Eigen::Index b : rest.cells) {
      const double apart = readings[a] - readings[b], sd = (derivatives.row(a) - derivatives.row(b)).norm();
      sum += sd > 0 ? 0.5 * std::erfc(-apart / (sd * std::sqrt(2.0))) : (apart > 0) + 0.5 * (apart == 0);
    }
  return sum / static_cast<double>(letter.cells.size() * rest.cells.size());
}

}  // namespace

DisplayTolerance as_made_display(const std::vector<double>& readings, const std::vector<double>& levels,
                                 const MatrixXd& derivatives) {
  const Group letter = group(readings, levels, derivatives, true),
              rest = group(readings, levels, derivatives, false);
  const double apart = letter.mean - rest.mean, variance = (letter.variance + rest.variance) / 2;
  const double apart_sd = (letter.mean_gradient - rest.mean_gradient).norm(),
               variance_sd = std::sqrt(letter.variance_of_variance + rest.variance_of_variance) / 2;
  DisplayTolerance out;
  out.contrast = apart / std::sqrt(variance);
  const double sd = std::hypot(apart_sd / std::sqrt(variance), out.contrast * variance_sd / (2 * variance));
  out.contrast_p05 = out.contrast - model::quantile_95 * sd;
  out.auc = expected_auc(readings, letter, rest, derivatives);
  return out;
}

}  // namespace kinetix::optim
