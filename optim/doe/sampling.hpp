#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "optim/doe/factor.hpp"

namespace kinetix::optim {

/// How samples are laid out. With d factors; "samples" is SamplingOptions::samples.
enum class SamplingMethod {
  /// Every combination of the factors' levels once, in the order of nested loops, the last factor fastest.
  factorial,
  /// Latin hypercube: `samples` rows; of as many strata of the same probability, each factor has one row in
  /// each, at a random place inside; no other optimisation (McKay, Beckman, Conover, Technometrics 21, 239,
  /// 1979).
  lhs,
  /// The first `samples` points of Sobol's sequence, moved by a digital shift that the seed decides. Take a
  /// power of two. Up to 3667 factors.
  sobol,
  /// `samples` independent draws.
  monte_carlo,
  /// Row 0 is the base point; then, factor by factor, one row for each of its levels, all else at the base
  /// (also where the level is the base's value): 1 + sum of levels rows.
  one_at_a_time,
  /// Elementary effects: `samples` trajectories of d + 1 rows. A trajectory starts at random levels and moves
  /// one factor after the other, in random order, by half its levels (Morris, Technometrics 33, 161, 1991), all steps of a
  /// factor of one size (even_level_value). Takes an even number of levels to visit all alike. 10 to 50 trajectories are usual.
  morris,
  /// For Sobol's indices: `samples` is the base N, and there are N (d + 2) rows: for each n, row A, the d
  /// rows A with one factor of B, and row B; A and B are two halves of one Sobol sequence in 2 d dimensions
  /// with a digital shift (Saltelli et al., Comput. Phys. Commun. 181, 259, 2010). Take a power of two, 512
  /// or more. Up to 1833 factors. Any first rows that are a multiple of d + 2 are the table of a smaller
  /// base.
  saltelli
};

struct SamplingOptions {
  SamplingMethod method = SamplingMethod::sobol;
  std::uint64_t samples = 1024;  ///< 1 to 2^62; what it counts is said at each method
  std::uint64_t seed = 0;
  /// For one_at_a_time: value of each factor in its unit, finite; empty = quantile 0.5 of each.
  std::vector<double> base;
};

class Sampler;

/// The rows of a design of experiments, each made alone: row i depends on the factors, the options and i,
/// never on which rows were asked for before or on the thread. Nothing is kept that grows with the number of
/// rows. Safe to read from many threads.
class SamplePlan {
 public:
  /// @throws InvalidInput without factors, for two of the same name, for a factor or options that do not
  /// validate, and for more factors than the method can have
  SamplePlan(std::vector<Factor> factors, SamplingOptions options);

  const std::vector<Factor>& factors() const { return *factors_; }
  const SamplingOptions& options() const { return options_; }

  /// Rows; the largest 64-bit number where there would be that many or more.
  std::uint64_t size() const;

  /// Row i, in the factors' units; time in proportion to the factors. @param i below size()
  /// @param values as many as factors; filled   @throws InvalidInput for other sizes, and for rows past the end
  void sample(std::uint64_t i, std::span<double> values) const;
  std::vector<double> sample(std::uint64_t i) const;

 private:
  std::shared_ptr<const std::vector<Factor>> factors_;
  SamplingOptions options_;
  std::shared_ptr<const Sampler> sampler_;
};

}  // namespace kinetix::optim
