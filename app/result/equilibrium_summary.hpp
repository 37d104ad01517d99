#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// How a path stopped, for people: result.json says `torn` where a hinge was overstretched.
std::string in_words(model::EquilibriumPath::Stop stop);

/// What the summary says of an equilibrium: lines of a label and a text. @pre run.equilibrium
std::vector<std::array<std::string, 2>> equilibrium_lines(const Run& run);

}  // namespace kinetix::app
