#pragma once

#include "optim/doe/sampling.hpp"

namespace kinetix::optim {

/// A method that has been given its factors; as SamplePlan.
class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual std::uint64_t size() const = 0;
  virtual void sample(std::uint64_t i, std::span<double> values) const = 0;
};

/// What the samplers read; outlives them by sharing.
using SharedFactors = std::shared_ptr<const std::vector<Factor>>;

/// a b, or the largest 64-bit number where that is less.
std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b);

/// lhs, sobol, monte_carlo, saltelli: places in the unit cube, put through each factor's quantile.
/// @throws InvalidInput for more factors than Sobol's sequence has dimensions for
std::unique_ptr<const Sampler> make_unit_sampler(SharedFactors factors, const SamplingOptions& options);

/// factorial, one_at_a_time, morris. @throws InvalidInput for a base point that does not fit, and for a
/// factor of one level in morris
std::unique_ptr<const Sampler> make_level_sampler(SharedFactors factors, const SamplingOptions& options);

}  // namespace kinetix::optim
