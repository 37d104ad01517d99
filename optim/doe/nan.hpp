#pragma once

#include <limits>

namespace kinetix::optim {

/// What is not known, of samples that failed and of statistics that need more of them. No unit.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace kinetix::optim
