#pragma once

#include <cstdint>
#include <limits>
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

}  // namespace kinetix::optim
