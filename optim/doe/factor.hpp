#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace kinetix::optim {

/// Every value of [lower, upper] alike; lower < upper, finite, in the factor's unit.
struct UniformRange {
  double lower = 0, upper = 1;
};

/// A normal distribution, what lies outside [lower, upper] cut off and the rest scaled up. `mean` and `sd`
/// are those before the cut; sd > 0, lower < upper, and at least 1e-300 of the probability inside. In the
/// factor's unit.
struct NormalSpread {
  double mean = 0, sd = 1;
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
};

/// These values alone and alike, in this order, in the factor's unit; at least one, finite, no two the same.
struct ValueList {
  std::vector<double> values;
};

/// What is varied. In whatever unit the caller has.
struct Factor {
  std::string name;
  std::variant<UniformRange, NormalSpread, ValueList> distribution;
  /// 2 to 10^9: values that the methods by levels (factorial, one at a time, Morris) take from a range or a
  /// normal distribution. A list has as many levels as values.
  std::int64_t levels = 4;

  /// @throws InvalidInput naming the factor, the field, its value and the rule
  void validate() const;
};

/// The value below which a share u of the distribution lies: a range's lower + u (upper - lower), a normal
/// distribution's inverse distribution function (Boost.Math's inverse of erfc, in double), value floor(u n)
/// of a list. @param u 0 < u < 1
double quantile(const Factor& factor, double u);

std::int64_t level_count(const Factor& factor);

/// Level k of the factor: of a range, evenly spaced with both ends; of a normal distribution, the medians of
/// as many parts of the same probability; of a list, value k. @param k 0 to level_count - 1
double level_value(const Factor& factor, std::int64_t k);

/// The same with steps of one size: of a normal distribution, level_count values evenly spaced between its first and its last
/// level, since steps between its medians differ.
double even_level_value(const Factor& factor, std::int64_t k);

}  // namespace kinetix::optim
