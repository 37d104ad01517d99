#include <algorithm>
#include <cmath>

#include "model/base/decompositions.hpp"
#include "optim/doe/analysis.hpp"

namespace kinetix::optim {
namespace {

/// Smallest pivot of a correlation matrix that counts as not singular: the share of a factor's variance that
/// the others do not explain. Smaller ones are rounding.
constexpr double min_pivot = 1e-10;

/// Returns the column minus its mean, over its length. NaN for a column that does not vary.
Eigen::VectorXd standardised(const Eigen::VectorXd& column) {
  if (column.maxCoeff() == column.minCoeff()) return Eigen::VectorXd::Constant(column.size(), nan);
  const Eigen::VectorXd centred = column.array() - column.mean();
  return centred / centred.norm();
}

/// Returns ranks from 0; equal values share their mean rank.
Eigen::VectorXd ranks(const Eigen::VectorXd& column) {
  const Eigen::Index n = column.size();
  std::vector<Eigen::Index> order(n);
  for (Eigen::Index i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return column[a] < column[b]; });
  Eigen::VectorXd ranks(n);
  for (Eigen::Index first = 0, next = 0; first < n; first = next) {
    while (next < n && column[order[next]] == column[order[first]]) ++next;
    for (Eigen::Index k = first; k < next; ++k) ranks[order[k]] = 0.5 * static_cast<double>(first + next - 1);
  }
  return ranks;
}

double length(const Eigen::VectorXd& column) { return (column.array() - column.mean()).matrix().norm(); }

/// Computes correlations column by column: rounding in a matrix product depends on the number of threads.
Eigen::MatrixXd correlations(const Eigen::MatrixXd& x) {
  Eigen::MatrixXd all(x.cols(), x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (Eigen::Index k = 0; k <= j; ++k) all(j, k) = all(k, j) = x.col(j).dot(x.col(k));
  return all;
}

/// Coefficients of the standardised factors by the normal equations, whose matrix is their correlation. The
/// diagonal of its inverse gives the errors. Empty if the matrix is singular.
struct Regression {
  Eigen::VectorXd coefficients, inverse_diagonal;
};

Regression regress(const Eigen::MatrixXd& correlation, const Eigen::VectorXd& with_response) {
  if (correlation.size() == 0 || !with_response.allFinite()) return {};
  const SymmetricFactor factor(correlation);
  if (!(factor.min_pivot() > min_pivot)) return {};
  return {factor.solve(with_response), factor.inverse_diagonal()};
}

/// @param x standardised columns of the factors that vary
void add_plane(const Eigen::MatrixXd& x, const std::vector<Eigen::Index>& factors,
               const Eigen::VectorXd& lengths, const Eigen::VectorXd& y, double y_length,
               LinearModel& model) {
  const Eigen::Index n = x.rows(), d = x.cols();
  if (n <= d + 1) return;
  const Regression plane = regress(correlations(x), x.transpose() * y);
  if (plane.coefficients.size() == 0) return;
  const double left = (y - x * plane.coefficients).squaredNorm();
  model.r_squared = 1 - left;
  for (Eigen::Index k = 0; k < d; ++k) {
    LinearEffect& effect = model.factors[factors[k]];
    const double scale = y_length / lengths[factors[k]];
    effect.standardised = plane.coefficients[k];
    effect.slope = scale * plane.coefficients[k];
    effect.slope_error = scale * std::sqrt(left / static_cast<double>(n - d - 1) * plane.inverse_diagonal[k]);
  }
}

double correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  return std::clamp(x.dot(y), -1.0, 1.0);
}

}  // namespace

LinearModel linear_effects(const SampleMatrix& samples, std::span<const double> responses) {
  check_table(samples, responses);
  const auto rows = usable_rows(responses);
  const auto n = static_cast<Eigen::Index>(rows.size());
  LinearModel model{std::vector<LinearEffect>(samples.cols(), {nan, nan, nan, nan, nan}), nan, n,
                    samples.rows() - n};
  if (n == 0) return model;
  const Eigen::VectorXd response = Eigen::Map<const Eigen::VectorXd>(responses.data(), samples.rows())(rows);
  const Eigen::VectorXd y = standardised(response), y_ranks = standardised(ranks(response));
  Eigen::MatrixXd x(n, samples.cols());
  Eigen::VectorXd lengths(samples.cols());
  std::vector<Eigen::Index> varying;
  for (Eigen::Index j = 0; j < samples.cols(); ++j) {
    const Eigen::VectorXd column = samples.col(j)(rows);
    x.col(j) = standardised(column);
    lengths[j] = length(column);
    if (x.col(j).allFinite()) varying.push_back(j);
    model.factors[j].correlation = correlation(x.col(j), y);
    model.factors[j].rank_correlation = correlation(standardised(ranks(column)), y_ranks);
  }
  add_plane(x(Eigen::all, varying), varying, lengths, y, length(response), model);
  return model;
}

Estimate linear_share(std::span<const double> correlations, std::int64_t used) {
  constexpr double sds = 1.96;  // standard deviations of 95 %
  if (used < 3) return {nan, nan, nan};
  double squares = 0;
  int varying = 0;
  for (const double r : correlations)
    if (std::isfinite(r)) {
      squares += r * r;
      ++varying;
    }
  if (varying == 0) return {nan, nan, nan};
  const double free = static_cast<double>(used - 1), by_chance = varying / free;
  const double share = (squares - by_chance) * free / (free - 1), bounded = std::clamp(share, 0.0, 1.0),
               sd = std::sqrt(2 * varying / (free * free) + 4 * bounded / free);
  return {share, std::max(share - sds * sd, 0.0), std::min(share + sds * sd, 1.0)};
}

}  // namespace kinetix::optim
