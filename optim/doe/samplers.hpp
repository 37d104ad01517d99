#pragma once

#include "optim/doe/sampling.hpp"

namespace kinetix::optim {

/// Sobol's sequence with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30, 2635, 2008), in the
/// order of Antonov and Saleev. It starts with the origin. A power of two of points that starts at a multiple
/// of that power fills every dimension evenly, so the sample count should be a power of two.
class SobolSequence {
 public:
  static constexpr int max_dimensions = 3667;  ///< Boost has direction numbers for this many

  /// @param dimensions 1 to max_dimensions
  explicit SobolSequence(int dimensions);

  int dimensions() const { return dimensions_; }

  /// Returns the coordinate of point `index`, as a fraction of 2^64. A digital shift is the xor of all points
  /// with the same random bits. It keeps the evenness and moves the origin away from the boundary.
  std::uint64_t coordinate(std::uint64_t index, int dimension) const;

 private:
  int dimensions_;
  std::vector<std::uint64_t> directions_;  ///< bit by bit, the 64 of dimension 0 first
};

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
