#pragma once

#include "app/goals/outline/outline_file.hpp"
#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// A panel whose rim takes a shape when it is pressed: the search, the closed form, and the physics run.
std::unique_ptr<Goal> make_goal(OutlineFile file);

extern const GoalKind outline_kind;

}  // namespace kinetix::app
