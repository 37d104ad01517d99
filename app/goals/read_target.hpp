#pragma once

#include <string>

#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// @throws InvalidInput for whatever formats.md does not allow, and for kinds that are not supported
Target read_target(const std::string& file);
/// The same of a document in memory.
Target read_target(const targets::Node& root);

}  // namespace kinetix::app
