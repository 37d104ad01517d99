#pragma once

#include "app/run/goal.hpp"

namespace kinetix::app {

/// Returns all kinds of goals, in the order of the documentation.
const std::vector<const GoalKind*>& goal_kinds();

/// Adds a kind, for programs that link this library. Not thread-safe against readers of the list.
/// @param kind must outlive all use. @pre no other kind has its name
void add_goal_kind(const GoalKind& kind);

/// Reads a target file. @throws InvalidInput for whatever formats.md does not allow, and for unknown kinds
Target read_target(const std::string& file);
/// Reads a target from a document in memory. @throws InvalidInput if the document is not a valid target
Target read_target(const targets::Node& root);

}  // namespace kinetix::app
