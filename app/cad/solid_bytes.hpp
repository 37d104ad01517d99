#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/cad/found_solid.hpp"

namespace kinetix::app::cad {

// How kinetix-read-step gives solids to the program that started it.

std::string to_bytes(const std::vector<FoundSolid>& solids);

/// @throws std::runtime_error for bytes that end early, and for triangles of points that are not there
std::vector<FoundSolid> read_solids(std::string_view bytes);

}  // namespace kinetix::app::cad
