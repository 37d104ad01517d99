#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace kinetix::optim {

/// Uniform distribution on [lower, upper]; lower < upper, finite, in the factor's unit.
struct UniformRange {
  double lower = 0, upper = 1;
};

/// Normal distribution cut off outside [lower, upper], with the rest scaled up. `mean` and `sd` are those
/// before the cut. sd > 0, lower < upper, and at least 1e-300 of the probability inside. In the factor's
/// unit.
struct NormalSpread {
  double mean = 0, sd = 1;
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
};

/// Discrete distribution: only these values, in this order and equally probable. In the factor's unit; at
/// least one, finite, all different.
struct ValueList {
  std::vector<double> values;
};

/// Varied quantity, in any unit of the caller.
struct Factor {
  std::string name;
  std::variant<UniformRange, NormalSpread, ValueList> distribution;
  /// 2 to 10^9: number of values that the methods by levels (factorial, one at a time, Morris) take from a
  /// range or a normal distribution. A list has as many levels as values.
  std::int64_t levels = 4;

  /// @throws InvalidInput naming the factor, the field, its value and the rule
  void validate() const;
};

/// Returns the value below which a share u of the distribution is. For a range it is lower + u (upper -
/// lower). For a normal distribution it is the inverse distribution function (Boost.Math's inverse of erfc,
/// in double). For a list it is value floor(u n). @param u 0 < u < 1
double quantile(const Factor& factor, double u);

std::int64_t level_count(const Factor& factor);

/// Returns level k of the factor. Levels of a range are evenly spaced and include both ends. Levels of a
/// normal distribution are the medians of parts of equal probability. Level k of a list is value k.
/// @param k 0 to level_count - 1
double level_value(const Factor& factor, std::int64_t k);

/// Returns level k of level_count levels with equal steps. For a normal distribution they are evenly spaced
/// between its first and its last level, since steps between its medians differ.
double even_level_value(const Factor& factor, std::int64_t k);

/// Layout of the samples. d is the number of factors; `samples` is SamplingOptions::samples.
enum class SamplingMethod {
  /// Every combination of the factors' levels once, in the order of nested loops, the last factor fastest.
  factorial,
  /// Latin hypercube of `samples` rows. Each factor has one row in each of `samples` strata of equal
  /// probability, at a random place inside. No further optimisation (McKay, Beckman, Conover, Technometrics
  /// 21, 239, 1979).
  lhs,
  /// First `samples` points of Sobol's sequence, moved by a digital shift that depends on the seed. Use a
  /// power of two. Up to 3667 factors.
  sobol,
  /// `samples` independent draws.
  monte_carlo,
  /// Row 0 is the base point. Then each factor in turn has one row per level, all others at the base: 1 + sum
  /// of levels rows. The base's value has a row too if it is one of the levels.
  one_factor,
  /// Elementary effects: `samples` trajectories of d + 1 rows. A trajectory starts at random levels and moves
  /// one factor after the other, in random order, by half its levels (Morris, Technometrics 33, 161, 1991).
  /// All steps of a factor have one size (even_level_value). Only an even number of levels visits all equally
  /// often. 10 to 50 trajectories are usual.
  morris,
  /// Table for Sobol's indices with base N = `samples`. It has N (d + 2) rows: for each n, row A, the d rows
  /// A with one factor of B, and row B. A and B are the two halves of one Sobol sequence in 2 d dimensions
  /// with a digital shift (Saltelli et al., Comput. Phys. Commun. 181, 259, 2010). Use a power of two, 512 or
  /// more. Up to 1833 factors. Any first rows that are a multiple of d + 2 are the table of a smaller base.
  saltelli,
  one_at_a_time [[deprecated("one_factor")]] = one_factor,
};

struct SamplingOptions {
  SamplingMethod method = SamplingMethod::sobol;
  std::uint64_t samples = 1024;  ///< 1 to 2^62; counts the items given at each method
  std::uint64_t seed = 0;
  /// Base point of one_factor: value of each factor in its unit, finite; empty: quantile 0.5 of each.
  std::vector<double> base;
};

class Sampler;

/// Rows of a design of experiments, each computed separately. Row i depends on the factors, the options and i
/// only, not on earlier calls or the thread. Memory does not grow with the number of rows. Safe to read from
/// many threads.
class SamplePlan {
 public:
  /// @throws InvalidInput without factors, for two of one name, for an invalid factor or invalid options, and
  /// for more factors than the method allows
  SamplePlan(std::vector<Factor> factors, SamplingOptions options);

  const std::vector<Factor>& factors() const { return *factors_; }
  const SamplingOptions& options() const { return options_; }

  /// Returns the number of rows, at most the largest 64-bit number.
  std::uint64_t size() const;

  /// Computes row i in the factors' units; time in proportion to the factors.
  /// @param i below size()
  /// @param values output, as many as factors
  /// @throws InvalidInput for other sizes, and for rows past the end
  void sample(std::uint64_t i, std::span<double> values) const;
  std::vector<double> sample(std::uint64_t i) const;

 private:
  std::shared_ptr<const std::vector<Factor>> factors_;
  SamplingOptions options_;
  std::shared_ptr<const Sampler> sampler_;
};

}  // namespace kinetix::optim
