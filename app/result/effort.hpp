#pragma once

#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

/// What a force on plates takes, N: "fingers", "a hand", "both arms", "a vice". The limits are those of handbooks of
/// ergonomics, rounded down, as what most adults do without strain.
std::string effort_of_force(double newtons);
/// What turning a hinge takes, N mm: likewise.
std::string effort_of_moment(double newton_mm);
/// What the largest load on the way takes; springs of shape memory need nobody.
std::string effort_of(const Equilibrium& equilibrium);
/// What the load on hinges takes that a file left open. @pre it is known
std::string effort_of(const TakenHinges& taken);

}  // namespace kinetix::app
