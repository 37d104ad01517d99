#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace kinetix::targets {

/// The numbers that a key allows, and the unit they are in.
struct Bounds {
  /// Both in units of `unit`.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_allowed = true, upper_allowed = true;
  std::string_view unit = {};  ///< "mm", "degrees", ...; empty for a plain number

  /// Whether a number in the unit is allowed. False for NaN and for infinities.
  bool contains(double x) const;
  /// "a number above 0, in mm"
  std::string describe() const;
};

/// Ends are in the unit.
Bounds above(double lower, std::string_view unit = {});
Bounds at_least(double lower, std::string_view unit = {});
Bounds from_to(double lower, double upper, std::string_view unit = {});
/// Both ends excluded.
Bounds between(double lower, double upper, std::string_view unit = {});
/// Range of a share, or of a size over another one: above 0 and up to 1.
inline constexpr Bounds part_of_one = {0, 1, false, true};
/// Range of a place along something, without its ends.
inline constexpr Bounds place_along = {0, 1, false, false};

/// Reads a decimal number in the unit of the bounds, independent of the locale.
/// @throws InvalidInput without a place, saying what is allowed: not a number, not finite, a unit or a decimal comma
/// in it, outside the bounds
double parse_number(std::string_view text, const Bounds& bounds = {});

/// Reads a whole number without a fraction or an exponent. @throws InvalidInput as parse_number
int parse_integer(std::string_view text, int lower, int upper);

/// Formats a number with the fewest digits that parse_number reads back to the same double.
std::string shortest_text(double x);

/// Converts degrees as text to radians, rounded once (in extended precision between).
/// @throws InvalidInput as parse_number
double parse_degrees(std::string_view text, const Bounds& degrees);

/// Converts degrees to radians, to the last bit of what parse_degrees gives for their shortest text.
double radians_of(double degrees);

/// Formats an angle in degrees that parse_degrees reads back to exactly the same radians (and -0 to 0). @pre finite
std::string degrees_text(double radians);

}  // namespace kinetix::targets
