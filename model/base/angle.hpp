#pragma once

#include <numbers>

namespace kinetix {

inline constexpr double pi = std::numbers::pi;  ///< rad, half a turn
/// Radians per degree. Files and messages use degrees.
inline constexpr double radians_per_degree = pi / 180.0;
/// Converts an angle from rad to degrees, for messages: code works in radians.
constexpr double to_degrees(double radians) { return radians / radians_per_degree; }

}  // namespace kinetix
