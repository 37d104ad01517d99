#include <fmt/format.h>
#include <cmath>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "optim/doe/analysis.hpp"

namespace kinetix::optim {
namespace {

using Bases = Eigen::Map<const Eigen::MatrixXd>;  ///< a column for each base: A, A with each factor of B, B

/// Terms whose means are the estimators, a column per base. The rows are the first-order term of each factor,
/// the total term of each, the mean of A and B, and the mean of their squares. A term that a failed row makes
/// unknown is a gap.
class Terms {
 public:
  /// @param centred bases minus the approximate mean response
  explicit Terms(const Eigen::MatrixXd& centred)
      : factors_(centred.rows() - 2), terms_(2 * factors_ + 2, centred.cols()) {
    for (Eigen::Index n = 0; n < centred.cols(); ++n) {
      const double a = centred(0, n), b = centred(factors_ + 1, n);
      const Eigen::ArrayXd change = centred.col(n).segment(1, factors_).array() - a;
      terms_.col(n) << b * change, change.square() / 2, (a + b) / 2, (a * a + b * b) / 2;
      close_gaps(n);
    }
  }

  Eigen::Index factors() const { return factors_; }
  Eigen::Index bases() const { return terms_.cols(); }

  /// Returns the number of bases for which each term is known, with base n counted weights[n] times.
  Eigen::ArrayXd counts(const Eigen::VectorXd& weights) const {
    Eigen::ArrayXd counts = Eigen::ArrayXd::Constant(terms_.rows(), weights.sum());
    for (const auto& [row, base] : gaps_) counts[row] -= weights[base];
    return counts;
  }

  /// Returns the means of the terms; NaN for a term that is known for fewer than two bases.
  Eigen::ArrayXd means(const Eigen::VectorXd& weights) const {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(terms_.rows());
    for (Eigen::Index n = 0; n < bases(); ++n)
      if (weights[n] > 0) sums += weights[n] * terms_.col(n);
    const Eigen::ArrayXd known = counts(weights);
    return (known >= 2).select(sums.array() / known, nan);
  }

 private:
  void close_gaps(Eigen::Index n) {
    for (Eigen::Index row = 0; row < terms_.rows(); ++row)
      if (!std::isfinite(terms_(row, n))) {
        terms_(row, n) = 0;
        gaps_.emplace_back(row, n);
      }
  }

  Eigen::Index factors_;
  Eigen::MatrixXd terms_;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> gaps_;
};

struct Indices {
  Eigen::ArrayXd values;  ///< first-order of each factor, then total
  double variance;
};

Indices indices(const Terms& terms, const Eigen::VectorXd& weights) {
  const Eigen::ArrayXd means = terms.means(weights);
  const Eigen::Index rows = 2 * terms.factors();
  const double variance = means[rows + 1] - means[rows] * means[rows];
  return {means.head(rows) / (variance > 0 ? variance : nan), variance};
}

/// Returns the mean of the finite rows A and B. It is computed about one of them, so that a constant response
/// is reproduced to the bit.
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

/// Returns the number of times that each base is drawn.
Eigen::VectorXd draw(std::uint64_t seed, int resample, Eigen::Index bases) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(bases);
  for (Eigen::Index n = 0; n < bases; ++n) ++weights[resampled_row(seed, resample, n, bases)];
  return weights;
}

/// Returns a row per resample.
Eigen::MatrixXd resampled_indices(const Terms& terms, const ConfidenceOptions& options) {
  Eigen::MatrixXd resampled(options.resamples, 2 * terms.factors());
  for (int k = 0; k < options.resamples; ++k)
    resampled.row(k) = indices(terms, draw(options.seed, k, terms.bases())).values.transpose();
  return resampled;
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
  const Terms terms(bases.array() - middle);
  const Eigen::VectorXd once = Eigen::VectorXd::Ones(terms.bases());
  const Indices found = indices(terms, once);
  const Eigen::ArrayXd counts = terms.counts(once);
  const Eigen::MatrixXd resampled = resampled_indices(terms, options);
  const auto estimate = [&](Eigen::Index k) {
    const auto column = resampled.col(k);
    return percentile_estimate(found.values[k], {column.begin(), column.end()}, options.level);
  };
  SobolIndices result{{}, middle, found.variance, bases.cols(), 0};
  result.failed = static_cast<std::int64_t>(responses.size() - usable_rows(responses).size());
  for (int j = 0; j < factors; ++j)
    result.factors.push_back({estimate(j), estimate(factors + j), static_cast<std::int64_t>(counts[j]),
                              static_cast<std::int64_t>(counts[factors + j])});
  return result;
}

}  // namespace kinetix::optim
