#pragma once

#include <vector>

#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// The kinds of goals there are, in the order of the documentation.
const std::vector<const GoalKind*>& goal_kinds();

/// Adds a kind, for programs that link this library. Not while others read the list.
/// @param kind must outlive all use. @pre no other kind has its name
void add_goal_kind(const GoalKind& kind);

}  // namespace kinetix::app
