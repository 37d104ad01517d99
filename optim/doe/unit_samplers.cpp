#include <fmt/format.h>

#include <algorithm>

#include "model/base/invalid_input.hpp"
#include "optim/doe/random.hpp"
#include "optim/doe/samplers.hpp"
#include "optim/doe/sobol_sequence.hpp"

namespace kinetix::optim {
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
    if (dimensions > SobolSequence::most_dimensions)
      throw InvalidInput(
          fmt::format("the factors need {} dimensions of Sobol's sequence, which has at most {}", dimensions,
                      SobolSequence::most_dimensions));
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

}  // namespace kinetix::optim
