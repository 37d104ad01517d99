#pragma once

#include <cmath>

namespace kinetix {

/// Returns the larger of two numbers; NaN if either is NaN, so that a running maximum keeps it.
inline double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

}  // namespace kinetix
