#pragma once

#include "app/goals/display/display_file.hpp"
#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// A panel that shows a picture when it is compressed: the search, its equilibrium from flat, and the
/// physics run of its compression. Its search throws InvalidInput for a panel whose walls overlap, and for
/// one that the machine's memory does not hold.
std::unique_ptr<Goal> make_goal(DisplayFile file);

extern const GoalKind display_kind;

}  // namespace kinetix::app
