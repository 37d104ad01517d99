#include "optim/doe/analysis.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "optim/doe/random.hpp"

namespace kinetix::optim {

double sample_quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

void ConfidenceOptions::validate() const {
  if (!(level > 0 && level < 1))
    throw InvalidInput(fmt::format("confidence level is {}, must be above 0 and below 1", level));
  if (!(resamples >= 2 && resamples <= 100'000))
    throw InvalidInput(fmt::format("resamples is {}, must be 2 to 100000", resamples));
}

Estimate percentile_estimate(double value, std::vector<double> resampled, double level) {
  std::erase_if(resampled, [](double x) { return !std::isfinite(x); });
  if (!std::isfinite(value) || resampled.empty()) return {value, nan, nan};
  std::sort(resampled.begin(), resampled.end());
  const double outside = (1 - level) / 2;
  return {value, sample_quantile(resampled, outside), sample_quantile(resampled, 1 - outside)};
}

std::uint64_t resampled_row(std::uint64_t seed, int resample, std::uint64_t draw, std::uint64_t rows) {
  return random_bits(seed, RandomStream::bootstrap, draw, static_cast<std::uint32_t>(resample)) % rows;
}

void check_table(const SampleMatrix& samples, std::span<const double> responses) {
  if (samples.cols() == 0) throw InvalidInput("the table has no factors, must have one or more");
  if (samples.rows() != static_cast<Eigen::Index>(responses.size()))
    throw InvalidInput(
        fmt::format("{} responses for {} samples, must be one for each", responses.size(), samples.rows()));
  for (Eigen::Index j = 0; j < samples.cols(); ++j)
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
      if (!std::isfinite(samples(i, j)))
        throw InvalidInput(fmt::format("factor {} of sample {} is {}, must be finite", j, i, samples(i, j)));
}

std::vector<Eigen::Index> usable_rows(std::span<const double> responses) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < responses.size(); ++i)
    if (std::isfinite(responses[i])) rows.push_back(static_cast<Eigen::Index>(i));
  return rows;
}

}  // namespace kinetix::optim
