#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/run.hpp"

namespace kinetix {

/// What the summary says of an equilibrium: lines of a label and a text. @pre run.equilibrium
std::vector<std::array<std::string, 2>> equilibrium_lines(const Run& run);

}  // namespace kinetix
