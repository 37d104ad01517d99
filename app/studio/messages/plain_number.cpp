#include "app/studio/messages/plain_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinetix::app::studio {

std::string plain_number(double value, int digits) {
  constexpr double least = 0.01,
                   most = 99'999.5;  // beyond, an exponent is read sooner than zeros are counted
  const double size = std::abs(value);
  if (value != 0 && !(size >= least && size < most)) return fmt::format("{:.{}g}", value, digits);
  const int before = value == 0 ? digits : static_cast<int>(std::floor(std::log10(size))) + 1;
  return fmt::format("{:.{}f}", value, std::max(0, digits - before));
}

}  // namespace kinetix::app::studio
