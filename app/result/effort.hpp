#pragma once

#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Classifies a force on plates, N: "fingers", "a hand", "both arms", "a vice". The limits are from ergonomics
/// handbooks, rounded down to what most adults can do without strain.
std::string effort_of_force(double newtons);
/// Classifies the moment of a driven hinge, N mm, by the same words.
std::string effort_of_moment(double newton_mm);
/// Describes the peak actuation load. Shape-memory drives need none: "its own springs".
std::string effort_of(const Equilibrium& equilibrium);
/// Classifies the load that holds assumed hinges at the design. @pre taken.load
std::string effort_of(const AssumedHinges& taken);

}  // namespace kinetix::app
