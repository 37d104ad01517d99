#pragma once

#include <cmath>

namespace kinetix {

/// The larger of two numbers; NaN where either is, so that a running maximum keeps it.
inline double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

}  // namespace kinetix
