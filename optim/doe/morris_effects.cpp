#include <fmt/format.h>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "optim/doe/analysis.hpp"

namespace kinetix::optim {
namespace {

Eigen::Index factor_of_step(const SampleMatrix& samples, Eigen::Index row) {
  Eigen::Index moved = -1, count = 0;
  for (Eigen::Index j = 0; j < samples.cols(); ++j)
    if (samples(row, j) != samples(row + 1, j)) moved = j, ++count;
  if (count == 1) return moved;
  throw InvalidInput(fmt::format(
      "samples {} and {} differ in {} factors, must differ in one: this is no table of trajectories", row,
      row + 1, count));
}

/// Returns a row per trajectory and a column per factor; NaN if a row at either end failed.
Eigen::MatrixXd elementary_effects(const SampleMatrix& samples, std::span<const double> responses) {
  const Eigen::Index d = samples.cols(), trajectories = samples.rows() / (d + 1);
  const Eigen::RowVectorXd span = samples.colwise().maxCoeff() - samples.colwise().minCoeff();
  Eigen::MatrixXd effects(trajectories, d);
  for (Eigen::Index r = 0; r < trajectories; ++r) {
    std::vector<bool> seen(d, false);
    for (Eigen::Index row = r * (d + 1); row < r * (d + 1) + d; ++row) {
      const Eigen::Index j = factor_of_step(samples, row);
      if (seen[j])
        throw InvalidInput(fmt::format("trajectory {} moves factor {} twice, must move it once", r, j));
      seen[j] = true;
      effects(r, j) =
          (responses[row + 1] - responses[row]) / (samples(row + 1, j) - samples(row, j)) * span[j];
    }
  }
  return effects;
}

struct Figures {
  double mu, mu_star, sigma;
};

/// @param row effect to use at place k
template <class Row>
Figures figures(const std::vector<double>& effects, const Row& row) {
  const double n = static_cast<double>(effects.size());
  double sum = 0, absolute = 0, squares = 0;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    sum += effects[row(k)];
    absolute += std::abs(effects[row(k)]);
  }
  for (std::size_t k = 0; k < effects.size(); ++k) squares += std::pow(effects[row(k)] - sum / n, 2);
  return {sum / n, absolute / n, effects.size() < 2 ? nan : std::sqrt(squares / (n - 1))};
}

MorrisEffect effect(const std::vector<double>& effects, std::int64_t dropped,
                    const ConfidenceOptions& options) {
  const auto used = static_cast<std::int64_t>(effects.size());
  const Figures all = figures(effects, [](std::size_t k) { return k; });
  std::vector<double> mu, mu_star, sigma;
  for (int b = 0; used > 0 && b < options.resamples; ++b) {
    const Figures drawn =
        figures(effects, [&](std::size_t k) { return resampled_row(options.seed, b, k, effects.size()); });
    mu.push_back(drawn.mu);
    mu_star.push_back(drawn.mu_star);
    sigma.push_back(drawn.sigma);
  }
  return {percentile_estimate(all.mu, mu, options.level),
          percentile_estimate(all.mu_star, mu_star, options.level),
          percentile_estimate(all.sigma, sigma, options.level), used, dropped};
}

}  // namespace

std::vector<MorrisEffect> morris_effects(const SampleMatrix& samples, std::span<const double> responses,
                                         const ConfidenceOptions& options) {
  options.validate();
  check_table(samples, responses);
  if (samples.rows() == 0 || samples.rows() % (samples.cols() + 1) != 0)
    throw InvalidInput(fmt::format("{} samples for trajectories of {} factors, must be a multiple of {}",
                                   samples.rows(), samples.cols(), samples.cols() + 1));
  const Eigen::MatrixXd table = elementary_effects(samples, responses);
  std::vector<MorrisEffect> result;
  for (const auto& column : table.colwise()) {
    std::vector<double> effects(column.begin(), column.end());
    std::erase_if(effects, [](double x) { return !std::isfinite(x); });
    const auto dropped = table.rows() - static_cast<Eigen::Index>(effects.size());
    result.push_back(effect(effects, dropped, options));
  }
  return result;
}

}  // namespace kinetix::optim
