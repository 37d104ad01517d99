#include "benchmarks/speed_error/log_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinetix::bench {
namespace {

constexpr double slack = 1e-9;  // of a decade: an end that is a power of ten is a tick in spite of rounding

/// Formats a number with two significant digits and no exponent.
std::string short_number(double value) {
  return value < 9.95 ? fmt::format("{:.1f}", value) : fmt::format("{:.0f}", value);
}

}  // namespace

double LogAxis::place(double value) const {
  const double share = std::log(value / low) / std::log(high / low);
  return from + std::clamp(share, 0.0, 1.0) * (to - from);
}

std::vector<double> LogAxis::ticks(int every) const {
  std::vector<double> powers;
  const int first = static_cast<int>(std::ceil(std::log10(low) - slack));
  const int last = static_cast<int>(std::floor(std::log10(high) + slack));
  for (int exponent = first; exponent <= last; ++exponent)
    if (exponent % every == 0) powers.push_back(std::pow(10.0, exponent));
  return powers;
}

std::string power_label(double power_of_ten) {
  const int exponent = static_cast<int>(std::lround(std::log10(power_of_ten)));
  if (std::abs(exponent) <= 2) return fmt::format("{:g}", std::pow(10.0, exponent));
  return fmt::format("10<tspan dy=\"-5\" font-size=\"8\">{}{}</tspan>", exponent < 0 ? "\u2212" : "",
                     std::abs(exponent));
}

std::string count_label(double count) {
  if (!(count >= 9.95)) return short_number(count);
  const double unit = std::pow(10.0, std::floor(std::log10(count)) - 1);
  const std::string digits = fmt::format("{:.0f}", std::round(count / unit) * unit);
  if (digits.size() < 5) return digits;
  std::string spaced;
  for (std::size_t k = 0; k < digits.size(); ++k) {
    if (k > 0 && (digits.size() - k) % 3 == 0) spaced += ' ';
    spaced += digits[k];
  }
  return spaced;
}

std::string time_label(double seconds) {
  if (seconds < 0.995e-3) return short_number(seconds * 1e6) + " us";
  if (seconds < 0.995) return short_number(seconds * 1e3) + " ms";
  return short_number(seconds) + " s";
}

}  // namespace kinetix::bench
