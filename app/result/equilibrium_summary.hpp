#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/run/drive_end.hpp"

namespace kinetix::app {

/// What the summary says of an equilibrium: lines of a label and a text. @pre run.equilibrium
std::vector<std::array<std::string, 2>> equilibrium_lines(const Run& run);

}  // namespace kinetix::app
