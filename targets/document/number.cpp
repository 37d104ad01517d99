#include "targets/document/number.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

// rad a degree. In extended precision, so that an angle is rounded once, at the end.
constexpr long double extended_radians_per_degree = std::numbers::pi_v<long double> / 180;

std::string_view without_plus(std::string_view text) {
  const bool plain_plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plain_plus ? text.substr(1) : text;
}

template <class Number>
std::from_chars_result parse(std::string_view text, Number& value) {
  return std::from_chars(text.data(), text.data() + text.size(), value);
}

bool is_infinite_or_nan(std::string_view text) {
  std::string word = lower_case(text);
  word.erase(0, word.find_first_not_of("+-."));
  return word == "inf" || word == "nan" || word == "infinity";
}

bool has_decimal_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return false;
  return comma > 0 && comma + 1 < text.size() && text.find(',', comma + 1) == std::string_view::npos &&
         text.find_first_not_of("+-0123456789,") == std::string_view::npos;
}

bool is_unit(std::string_view rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  const auto in_unit = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalpha(byte) || byte >= 0x80 || c == '%' || c == '"' || c == '/' || c == ' ';
  };
  return !rest.empty() && rest[0] != '/' && std::all_of(rest.begin(), rest.end(), in_unit);
}

[[noreturn]] void reject(std::string_view text, std::string_view rest, std::errc error,
                         const std::string& wanted) {
  if (text.empty()) throw InvalidInput("is empty. Give " + wanted);
  if (is_infinite_or_nan(text))
    throw InvalidInput(in_ticks(text) + " is not a finite number. Give " + wanted);
  if (has_decimal_comma(text))
    throw InvalidInput(in_ticks(text) + " has a decimal comma. Write a point, and give " + wanted);
  if (rest.empty() && error == std::errc::result_out_of_range)
    throw InvalidInput(in_ticks(text) + " is too large for a number. Give " + wanted);
  if (rest.size() < text.size() && is_unit(rest))
    throw InvalidInput(in_ticks(text) + " has a unit. Give " + wanted + ", without writing the unit");
  throw InvalidInput(in_ticks(text) + " is not a number. Give " + wanted);
}

constexpr double min_without_exponent =
    1e-6;  // in the unit of the limit: of smaller ones, zeros are not counted

constexpr std::size_t most_digits = 6;  // significant digits of a limit that is not rounded
constexpr int rounded_digits = 4;       // significant digits of a limit that is
constexpr double last_bits = 1e-9;      // of the last digit shown: an error of arithmetic, not a digit

std::size_t significant_digits(double x) {
  std::string text = shortest_text(x);
  text.erase(std::min(text.find('e'), text.size()));
  std::erase_if(text, [](char c) { return c == '-' || c == '.'; });
  text.erase(0, text.find_first_not_of('0'));
  text.erase(text.find_last_not_of('0') + 1);
  return text.size();
}

/// Rounds a limit with many digits, such as a multiple of the cell edge, to a number that the bounds allow.
/// @param up for a lower limit
double rounded_limit(double x, bool up) {
  if (x == 0 || significant_digits(x) <= most_digits) return x;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(x))) + 1 - rounded_digits);
  return (up ? std::ceil(x / unit - last_bits) : std::floor(x / unit + last_bits)) * unit;
}

/// A limit as a person writes it: 1000000 rather than 1e+06, and 0.00001 rather than 9.999999999999999e-06.
std::string limit_text(double x) {
  const bool is_short_integer = std::abs(x) < 1e9 && x == std::trunc(x);
  if (is_short_integer) return std::to_string(static_cast<long>(x));
  if (!(std::abs(x) >= min_without_exponent && std::abs(x) < 1e9)) return shortest_text(x);
  std::array<char, 32> digits;  // 9 before the point, 12 behind it
  std::string text(
      digits.data(),
      std::to_chars(digits.data(), digits.data() + digits.size(), x, std::chars_format::fixed, 12).ptr);
  text.erase(text.find_last_not_of('0') + 1);
  return text;
}

/// Writes 1e+05 as 1.0e+05: YAML 1.1 reads a number with an exponent and without a point as text.
std::string with_point(std::string text) {
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

}  // namespace

bool Bounds::contains(double x) const {
  return std::isfinite(x) && (lower_allowed ? x >= lower : x > lower) &&
         (upper_allowed ? x <= upper : x < upper);
}

std::string Bounds::describe() const {
  std::string text = "a number";
  const bool has_lower = std::isfinite(lower), has_upper = std::isfinite(upper);
  const std::string least = limit_text(rounded_limit(lower, true)),
                    most = limit_text(rounded_limit(upper, false));
  if (has_lower && has_upper && lower_allowed && upper_allowed)
    text += " from " + least + " to " + most;
  else {
    if (has_lower) text += (lower_allowed ? " of at least " : " above ") + least;
    if (has_upper)
      text += (has_lower ? " and " : " ") + std::string(upper_allowed ? "at most " : "below ") + most;
  }
  return unit.empty() ? text : text + ", in " + std::string(unit);
}

Bounds above(double lower, std::string_view unit) {
  return {.lower = lower, .lower_allowed = false, .unit = unit};
}

Bounds at_least(double lower, std::string_view unit) { return {.lower = lower, .unit = unit}; }

Bounds from_to(double lower, double upper, std::string_view unit) {
  return {.lower = lower, .upper = upper, .unit = unit};
}

Bounds between(double lower, double upper, std::string_view unit) {
  return {lower, upper, false, false, unit};
}

double parse_number(std::string_view text, const Bounds& bounds) {
  double value = 0;
  const std::string_view digits = without_plus(text);
  const auto [end, error] = parse(digits, value);
  const std::string_view rest = digits.substr(end - digits.data());
  if (error != std::errc{} || !rest.empty() || !std::isfinite(value))
    reject(text, rest, error, bounds.describe());
  if (!bounds.contains(value))
    throw InvalidInput(in_ticks(text) + " is out of range. Give " + bounds.describe());
  return value;
}

int parse_integer(std::string_view text, int lower, int upper) {
  const std::string wanted = "a whole number from " + std::to_string(lower) + " to " + std::to_string(upper);
  long long value = 0;
  const std::string_view digits = without_plus(text);
  const auto [end, error] = parse(digits, value);
  const bool whole = !text.empty() && end == digits.data() + digits.size();
  if (whole && error == std::errc{} && lower <= value && value <= upper) return static_cast<int>(value);
  if (whole) throw InvalidInput(in_ticks(text) + " is out of range. Give " + wanted);
  throw InvalidInput((text.empty() ? "is empty" : in_ticks(text) + " is not a whole number") + ". Give " +
                     wanted);
}

std::string shortest_text(double x) {
  char buffer[32];
  return with_point({buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr});
}

double parse_degrees(std::string_view text, const Bounds& degrees) {
  parse_number(text, degrees);
  long double value = 0;
  parse(without_plus(text), value);
  return static_cast<double>(value * extended_radians_per_degree);
}

double radians_of(double degrees) { return static_cast<double>(degrees * extended_radians_per_degree); }

std::string degrees_text(double radians) {
  char buffer[64];
  std::string text;
  radians += 0.0;  // -0 becomes 0
  for (int digits = 15; digits <= 21; ++digits) {
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, radians / extended_radians_per_degree,
                                   std::chars_format::general, digits);
    text = with_point({buffer, end.ptr});
    if (parse_degrees(text, {}) == radians) break;
  }
  return text;
}

}  // namespace kinetix::targets
