#pragma once

#include "app/goals/space_curve/space_curve_file.hpp"
#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// A strip that folds into a curve in space: the search, the closed form, and the physics run of its folding.
std::unique_ptr<Goal> make_goal(SpaceCurveFile file);

extern const GoalKind space_curve_kind;

}  // namespace kinetix::app
