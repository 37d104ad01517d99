#pragma once

#include <numbers>

namespace kinetix {

inline constexpr double pi = std::numbers::pi;
inline constexpr double radians_per_degree = pi / 180.0;
/// For messages: code works in radians.
constexpr double to_degrees(double radians) { return radians / radians_per_degree; }

}  // namespace kinetix
