#pragma once

#include <string>
#include <vector>

#include "app/run/goal_outcome.hpp"

namespace kinetix::app {

/// A zip archive with these files, compressed; always the same bytes for the same files.
/// @throws std::runtime_error where the library fails
std::string zip_text(const std::vector<NamedContent>& files);

}  // namespace kinetix::app
