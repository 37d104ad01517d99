#include "optim/doe/samplers.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <boost/random/sobol.hpp>
#include <cassert>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "optim/doe/random.hpp"

namespace kinetix::optim {
namespace {

constexpr int bits = 64;                // per coordinate, and as many directions per dimension
constexpr int last_bit_of_engine = 62;  // last direction at which the engine can be placed, see below

}  // namespace

// Point n is the xor of the directions of the bits of n's Gray code, so point 2^(k+1) - 1 is direction k
// alone. The engine omits the origin: its point n is our n + 1. It cannot be placed at the last direction; no
// table has 2^63 rows.
SobolSequence::SobolSequence(int dimensions) : dimensions_(dimensions), directions_(bits * dimensions, 0) {
  assert(dimensions >= 1 && dimensions <= max_dimensions);
  boost::random::sobol engine(dimensions);
  for (int k = 0; k <= last_bit_of_engine; ++k) {
    engine.seed((std::uint64_t{2} << k) - 2);
    for (int j = 0; j < dimensions; ++j) directions_[bits * j + k] = engine();
  }
}

std::uint64_t SobolSequence::coordinate(std::uint64_t index, int dimension) const {
  const std::uint64_t* direction = &directions_[bits * dimension];
  std::uint64_t coordinate = 0;
  for (std::uint64_t gray = index ^ index >> 1; gray != 0; gray &= gray - 1)
    coordinate ^= direction[std::countr_zero(gray)];
  return coordinate;
}

namespace {

class MonteCarlo final : public Sampler {
 public:
  MonteCarlo(SharedFactors factors, const SamplingOptions& options)
      : factors_(std::move(factors)), size_(options.samples), seed_(options.seed) {}

  std::uint64_t size() const override { return size_; }
  void sample(std::uint64_t i, std::span<double> values) const override {
    for (std::uint32_t j = 0; j < values.size(); ++j)
      values[j] =
          quantile((*factors_)[j], unit_interval(random_bits(seed_, RandomStream::monte_carlo, i, j)));
  }

 private:
  SharedFactors factors_;
  std::uint64_t size_, seed_;
};

/// Returns a random place in a stratum, of 24 bits: exact in double for up to 2^28 strata. Below 1 for any
/// number.
double place_in_stratum(std::uint64_t stratum, std::uint64_t strata, std::uint64_t bits) {
  const double place = (static_cast<double>(bits >> 40) + 0.5) * 0x1p-24;
  return std::min((static_cast<double>(stratum) + place) / static_cast<double>(strata), 1 - 0x1p-53);
}

class LatinHypercube final : public Sampler {
 public:
  LatinHypercube(SharedFactors factors, const SamplingOptions& options)
      : factors_(std::move(factors)), size_(options.samples), seed_(options.seed) {
    for (std::uint32_t j = 0; j < factors_->size(); ++j)
      orders_.emplace_back(size_, random_bits(seed_, RandomStream::stratum_order, 0, j));
  }

  std::uint64_t size() const override { return size_; }
  void sample(std::uint64_t i, std::span<double> values) const override {
    for (std::uint32_t j = 0; j < values.size(); ++j) {
      const std::uint64_t bits = random_bits(seed_, RandomStream::stratum_place, i, j);
      values[j] = quantile((*factors_)[j], place_in_stratum(orders_[j](i), size_, bits));
    }
  }

 private:
  SharedFactors factors_;
  std::uint64_t size_, seed_;
  std::vector<RandomOrder> orders_;
};

class ShiftedSobol {
 public:
  ShiftedSobol(std::size_t dimensions, std::uint64_t seed) : sequence_(checked(dimensions)) {
    for (std::uint32_t j = 0; j < dimensions; ++j)
      shifts_.push_back(random_bits(seed, RandomStream::digital_shift, 0, j));
  }

  double coordinate(std::uint64_t index, std::size_t dimension) const {
    return unit_interval(sequence_.coordinate(index, static_cast<int>(dimension)) ^ shifts_[dimension]);
  }

 private:
  static int checked(std::size_t dimensions) {
    if (dimensions > SobolSequence::max_dimensions)
      throw InvalidInput(
          fmt::format("the factors need {} dimensions of Sobol's sequence, which has at most {}", dimensions,
                      SobolSequence::max_dimensions));
    return static_cast<int>(dimensions);
  }

  SobolSequence sequence_;
  std::vector<std::uint64_t> shifts_;
};

class Sobol final : public Sampler {
 public:
  Sobol(SharedFactors factors, const SamplingOptions& options)
      : factors_(std::move(factors)), size_(options.samples), points_(factors_->size(), options.seed) {}

  std::uint64_t size() const override { return size_; }
  void sample(std::uint64_t i, std::span<double> values) const override {
    for (std::size_t j = 0; j < values.size(); ++j)
      values[j] = quantile((*factors_)[j], points_.coordinate(i, j));
  }

 private:
  SharedFactors factors_;
  std::uint64_t size_;
  ShiftedSobol points_;
};

class Saltelli final : public Sampler {
 public:
  Saltelli(SharedFactors factors, const SamplingOptions& options)
      : factors_(std::move(factors)), base_(options.samples), points_(2 * factors_->size(), options.seed) {}

  std::uint64_t size() const override { return saturating_product(base_, factors_->size() + 2); }
  void sample(std::uint64_t i, std::span<double> values) const override {
    const std::uint64_t d = values.size(), n = i / (d + 2), row = i % (d + 2);
    for (std::size_t j = 0; j < d; ++j) {
      const bool of_b = row == d + 1 || row == j + 1;
      values[j] = quantile((*factors_)[j], points_.coordinate(n, of_b ? d + j : j));
    }
  }

 private:
  SharedFactors factors_;
  std::uint64_t base_;
  ShiftedSobol points_;
};

}  // namespace

std::unique_ptr<const Sampler> make_unit_sampler(SharedFactors factors, const SamplingOptions& options) {
  switch (options.method) {
    case SamplingMethod::lhs:
      return std::make_unique<LatinHypercube>(std::move(factors), options);
    case SamplingMethod::sobol:
      return std::make_unique<Sobol>(std::move(factors), options);
    case SamplingMethod::saltelli:
      return std::make_unique<Saltelli>(std::move(factors), options);
    default:
      return std::make_unique<MonteCarlo>(std::move(factors), options);
  }
}

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
