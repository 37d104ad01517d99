#pragma once

#include <numbers>

namespace kinetix {

inline constexpr double pi = std::numbers::pi;  ///< rad, half a turn
/// Rad per deg: files and messages speak of degrees.
inline constexpr double radians_per_degree = pi / 180.0;
/// Of an angle in rad, deg. For messages: code works in radians.
constexpr double to_degrees(double radians) { return radians / radians_per_degree; }

}  // namespace kinetix
