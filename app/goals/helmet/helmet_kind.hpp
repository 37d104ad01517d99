#pragma once

#include "app/goals/helmet/helmet_file.hpp"
#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// Ribs on a spine that fit a head: layout, fit of all tilts and theta, and the physics run of its folding. All states are in the frame of the mesh, mm.
std::unique_ptr<Goal> make_goal(HelmetFile file);

extern const GoalKind helmet_kind;

}  // namespace kinetix::app
