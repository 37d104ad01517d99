#pragma once

#include <limits>

namespace kinetix::optim {

/// Unknown value: of failed samples, and of statistics with too few samples. No unit.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace kinetix::optim
