#pragma once

#include "app/goals/curve/curve_file.hpp"
#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// A strip that folds into a curve: the search, the closed form, and the physics run of its folding.
std::unique_ptr<Goal> make_goal(CurveFile file);

extern const GoalKind curve_kind;

}  // namespace kinetix::app
