#pragma once

#include "app/goals/surface/surface_file.hpp"
#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// A sheet that folds onto a doubly curved surface: the search, the closed form, and the physics run.
std::unique_ptr<Goal> make_goal(SurfaceFile file);

extern const GoalKind surface_kind;

}  // namespace kinetix::app
