#pragma once

#include <string>
#include <vector>

#include "app/run/goal.hpp"

namespace kinetix::app {

/// The kinds of goals there are, in the order of the documentation.
const std::vector<const GoalKind*>& goal_kinds();

/// Adds a kind, for programs that link this library. Not while others read the list.
/// @param kind must outlive all use. @pre no other kind has its name
void add_goal_kind(const GoalKind& kind);

/// @throws InvalidInput for whatever formats.md does not allow, and for kinds that are not supported
Target read_target(const std::string& file);
/// The same of a document in memory.
Target read_target(const targets::Node& root);

}  // namespace kinetix::app
