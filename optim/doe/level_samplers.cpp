#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/base/invalid_input.hpp"
#include "optim/doe/random.hpp"
#include "optim/doe/samplers.hpp"

namespace kinetix::optim {
namespace {

class Factorial final : public Sampler {
 public:
  explicit Factorial(SharedFactors factors) : factors_(std::move(factors)) {
    for (const Factor& factor : *factors_) size_ = saturating_product(size_, level_count(factor));
  }

  std::uint64_t size() const override { return size_; }
  void sample(std::uint64_t i, std::span<double> values) const override {
    for (std::size_t j = values.size(); j-- > 0;) {
      const Factor& factor = (*factors_)[j];
      const std::uint64_t levels = level_count(factor);
      values[j] = level_value(factor, static_cast<std::int64_t>(i % levels));
      i /= levels;
    }
  }

 private:
  SharedFactors factors_;
  std::uint64_t size_ = 1;
};

class OneAtATime final : public Sampler {
 public:
  OneAtATime(SharedFactors factors, const SamplingOptions& options)
      : factors_(std::move(factors)), base_(options.base) {
    if (base_.empty())
      for (const Factor& factor : *factors_) base_.push_back(quantile(factor, 0.5));
    check_base();
    first_rows_.push_back(1);
    for (const Factor& factor : *factors_) first_rows_.push_back(first_rows_.back() + level_count(factor));
  }

  std::uint64_t size() const override { return first_rows_.back(); }
  void sample(std::uint64_t i, std::span<double> values) const override {
    std::copy(base_.begin(), base_.end(), values.begin());
    if (i == 0) return;
    const auto next = std::upper_bound(first_rows_.begin(), first_rows_.end(), i);
    const std::size_t j = next - first_rows_.begin() - 1;
    values[j] = level_value((*factors_)[j], static_cast<std::int64_t>(i - first_rows_[j]));
  }

 private:
  void check_base() const {
    if (base_.size() != factors_->size())
      throw InvalidInput(fmt::format("base has {} values, must have one for each of {} factors", base_.size(),
                                     factors_->size()));
    for (const double value : base_)
      if (!std::isfinite(value)) throw InvalidInput(fmt::format("base holds {}, must be finite", value));
  }

  SharedFactors factors_;
  std::vector<double> base_;
  std::vector<std::uint64_t> first_rows_;  ///< of each factor; then the number of rows
};

/// Moves a level up by half the levels if that many are above it, otherwise down.
std::int64_t moved(std::int64_t level, std::int64_t levels) {
  const std::int64_t step = levels / 2;
  return level + step < levels ? level + step : level - step;
}

class Morris final : public Sampler {
 public:
  Morris(SharedFactors factors, const SamplingOptions& options)
      : factors_(std::move(factors)), trajectories_(options.samples), seed_(options.seed) {
    for (const Factor& factor : *factors_) {
      if (level_count(factor) < 2)
        throw InvalidInput(fmt::format("factor {}: one value, must be two or more for morris", factor.name));
      check_steps(factor);
    }
  }

  std::uint64_t size() const override { return saturating_product(trajectories_, factors_->size() + 1); }
  void sample(std::uint64_t i, std::span<double> values) const override {
    const std::uint64_t d = values.size(), trajectory = i / (d + 1), row = i % (d + 1);
    const RandomOrder turn(d, random_bits(seed_, RandomStream::trajectory_order, trajectory, 0));
    for (std::uint32_t j = 0; j < d; ++j) {
      const Factor& factor = (*factors_)[j];
      const std::int64_t levels = level_count(factor);
      const std::uint64_t draw = random_bits(seed_, RandomStream::trajectory_start, trajectory, j);
      const auto start = static_cast<std::int64_t>(draw % static_cast<std::uint64_t>(levels));
      values[j] = even_level_value(factor, turn(j) < row ? moved(start, levels) : start);
    }
  }

 private:
  /// Throws if rounding makes a step zero, which leaves its effect unknown. Lists have no value twice.
  static void check_steps(const Factor& factor) {
    const std::int64_t levels = level_count(factor), last = levels - 1;
    for (const std::int64_t level : {std::int64_t{0}, last})
      if (even_level_value(factor, level) == even_level_value(factor, moved(level, levels)))
        throw InvalidInput(fmt::format(
            "factor {}: too narrow for steps of morris: rounding makes its levels equal. Give it a "
            "larger range or sd",
            factor.name));
  }

  SharedFactors factors_;
  std::uint64_t trajectories_, seed_;
};

}  // namespace

std::unique_ptr<const Sampler> make_level_sampler(SharedFactors factors, const SamplingOptions& options) {
  switch (options.method) {
    case SamplingMethod::one_factor:
      return std::make_unique<OneAtATime>(std::move(factors), options);
    case SamplingMethod::morris:
      return std::make_unique<Morris>(std::move(factors), options);
    default:
      return std::make_unique<Factorial>(std::move(factors));
  }
}

}  // namespace kinetix::optim
