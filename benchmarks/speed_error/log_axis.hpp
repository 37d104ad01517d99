#pragma once

#include <string>
#include <vector>

namespace kinetix::bench {

/// A logarithmic axis of a plot: `low` is drawn at `from`, `high` at `to`.
struct LogAxis {
  double low = 1, high = 10;  ///< 0 < low < high
  double from = 0, to = 1;    ///< in the picture

  /// Values outside the axis are drawn at its end.
  double place(double value) const;

  /// Powers of ten on the axis, of those whose exponent is a multiple of `every`.
  std::vector<double> ticks(int every = 1) const;
};

/// "1", "10", "0.1", and "10^-5" with the exponent raised (SVG tspan) beyond a hundredth or a hundred.
std::string power_label(double power_of_ten);

/// "7.0", "42", "3400", "21 000": two significant digits.
std::string count_label(double count);

/// "1.5 us", "12 ms", "3.4 s": two significant digits.
std::string time_label(double seconds);

}  // namespace kinetix::bench
