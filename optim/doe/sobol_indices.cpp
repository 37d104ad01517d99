#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/invalid_input.hpp"
#include "optim/doe/sample_table.hpp"

namespace kinetix {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using Bases = Eigen::Map<const Eigen::MatrixXd>;  ///< a column for each base: A, A with each factor of B, B

/// Sums over bases of what the estimators are means of; a term that a failed row makes NaN is left out.
class IndexSums {
 public:
  explicit IndexSums(Eigen::Index factors)
      : first_(Eigen::ArrayXd::Zero(factors)), total_(first_), first_count_(first_), total_count_(first_) {}

  void add(const Eigen::Ref<const Eigen::VectorXd>& base) {
    const Eigen::Index d = first_.size();
    const double a = base[0], b = base[d + 1];
    if (std::isfinite(a) && std::isfinite(b)) add_row(a), add_row(b);
    for (Eigen::Index j = 0; j < d; ++j) {
      const double change = base[j + 1] - a, first = b * change, total = change * change / 2;
      if (std::isfinite(first)) first_[j] += first, ++first_count_[j];
      if (std::isfinite(total)) total_[j] += total, ++total_count_[j];
    }
  }

  double mean() const { return sum_ / rows_; }
  double variance() const { return std::max(0.0, squares_ / rows_ - mean() * mean()); }
  double first(Eigen::Index j) const { return index(first_[j], first_count_[j]); }
  double total(Eigen::Index j) const { return index(total_[j], total_count_[j]); }
  std::int64_t first_count(Eigen::Index j) const { return static_cast<std::int64_t>(first_count_[j]); }
  std::int64_t total_count(Eigen::Index j) const { return static_cast<std::int64_t>(total_count_[j]); }

 private:
  void add_row(double response) {
    sum_ += response;
    squares_ += response * response;
    ++rows_;
  }
  double index(double sum, double count) const {
    return count >= 2 && variance() > 0 ? sum / count / variance() : nan;
  }

  double sum_ = 0, squares_ = 0, rows_ = 0;
  Eigen::ArrayXd first_, total_, first_count_, total_count_;
};

/// Mean of the finite rows A and B, found about one of them so that a constant response gives itself to the
/// bit.
double centre(const Bases& bases) {
  double first = nan, sum = 0, count = 0;
  for (Eigen::Index n = 0; n < bases.cols(); ++n)
    for (const double response : {bases(0, n), bases(bases.rows() - 1, n)}) {
      if (!std::isfinite(response)) continue;
      if (count == 0) first = response;
      sum += response - first;
      ++count;
    }
  return first + sum / count;
}

IndexSums sums_of_all(const Eigen::MatrixXd& centred) {
  IndexSums sums(centred.rows() - 2);
  for (Eigen::Index n = 0; n < centred.cols(); ++n) sums.add(centred.col(n));
  return sums;
}

IndexSums sums_of_resample(const Eigen::MatrixXd& centred, std::uint64_t seed, int resample) {
  IndexSums sums(centred.rows() - 2);
  for (Eigen::Index n = 0; n < centred.cols(); ++n)
    sums.add(centred.col(static_cast<Eigen::Index>(resampled_row(seed, resample, n, centred.cols()))));
  return sums;
}

/// First-order indices, then total ones: a row for each resample.
Eigen::MatrixXd resampled_indices(const Eigen::MatrixXd& centred, const ConfidenceOptions& options) {
  const Eigen::Index d = centred.rows() - 2;
  Eigen::MatrixXd indices(options.resamples, 2 * d);
  for (int k = 0; k < options.resamples; ++k) {
    const IndexSums sums = sums_of_resample(centred, options.seed, k);
    for (Eigen::Index j = 0; j < d; ++j) {
      indices(k, j) = sums.first(j);
      indices(k, d + j) = sums.total(j);
    }
  }
  return indices;
}

void check_size(std::span<const double> responses, int factors) {
  if (!(factors >= 1)) throw InvalidInput(fmt::format("factors is {}, must be 1 or more", factors));
  if (responses.size() % (static_cast<std::size_t>(factors) + 2) != 0)
    throw InvalidInput(fmt::format("{} responses for Sobol's indices of {} factors, must be a multiple of {}",
                                   responses.size(), factors, factors + 2));
}

}  // namespace

SobolIndices sobol_indices(std::span<const double> responses, int factors, const ConfidenceOptions& options) {
  options.validate();
  check_size(responses, factors);
  const Bases bases(responses.data(), factors + 2,
                    static_cast<Eigen::Index>(responses.size()) / (factors + 2));
  const double middle = centre(bases);
  const Eigen::MatrixXd centred = bases.array() - middle;
  const IndexSums sums = sums_of_all(centred);
  const Eigen::MatrixXd resampled = resampled_indices(centred, options);
  const auto estimate = [&](double value, Eigen::Index column) {
    const auto values = resampled.col(column);
    return percentile_estimate(value, {values.begin(), values.end()}, options.level);
  };
  SobolIndices result{{}, middle, sums.variance(), bases.cols(), 0};
  result.failed = static_cast<std::int64_t>(responses.size() - usable_rows(responses).size());
  for (int j = 0; j < factors; ++j)
    result.factors.push_back({estimate(sums.first(j), j), estimate(sums.total(j), factors + j),
                              sums.first_count(j), sums.total_count(j)});
  return result;
}

}  // namespace kinetix
