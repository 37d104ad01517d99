#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// How a path stopped, for people: result.json says `torn` where a hinge was overstretched.
std::string in_words(model::EquilibriumPath::Stop stop);

/// Why an equilibrium is not what its drive was to lead to. @param theta that it came to, rad   @pre it stopped, or is on the
/// other side
std::string missed_words(const Equilibrium& equilibrium, double theta);

/// That the drive stops on its way, and why, one sentence. @pre it did
std::string drive_stop_reason(const Equilibrium& equilibrium);

/// What the summary says of an equilibrium: lines of a label and a text. @pre run.equilibrium
std::vector<std::array<std::string, 2>> equilibrium_lines(const Run& run);

}  // namespace kinetix::app
