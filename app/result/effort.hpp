#pragma once

#include <string>

namespace kinetix::app {

/// What a force on plates takes, N: "fingers", "a hand", "both arms", "a vice". The limits are those of handbooks of
/// ergonomics, rounded down, as what most adults do without strain.
std::string effort_of_force(double newtons);
/// Springs of shape memory need nobody.
inline constexpr const char* effort_of_springs = "its own springs";
/// What turning a hinge takes, N mm: likewise.
std::string effort_of_moment(double newton_mm);

}  // namespace kinetix::app
