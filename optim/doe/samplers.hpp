#pragma once

#include "optim/doe/sampling.hpp"

namespace kinetix::optim {

/// Sampling method with its factors; functions as in SamplePlan.
class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual std::uint64_t size() const = 0;
  virtual void sample(std::uint64_t i, std::span<double> values) const = 0;
};

/// Factors of the samplers, with shared ownership.
using SharedFactors = std::shared_ptr<const std::vector<Factor>>;

/// Returns a b, or the largest 64-bit number if a b exceeds it.
std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b);

/// Makes the sampler of lhs, sobol, monte_carlo or saltelli: places in the unit cube, mapped by each factor's
/// quantile.
/// @throws InvalidInput for more factors than Sobol's sequence has dimensions
std::unique_ptr<const Sampler> make_unit_sampler(SharedFactors factors, const SamplingOptions& options);

/// Makes the sampler of factorial, one_factor or morris.
/// @throws InvalidInput for a base point that does not fit, and for a factor of one level in morris
std::unique_ptr<const Sampler> make_level_sampler(SharedFactors factors, const SamplingOptions& options);

}  // namespace kinetix::optim
