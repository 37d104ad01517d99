#pragma once

#include <algorithm>

#include "app/goals/fold/fold_file.hpp"
#include "app/run/goal_kind.hpp"
#include "model/base/angle.hpp"

namespace kinetix::app {

/// Where searches for folds mostly end, rad: what is told of them beforehand.
inline double usual_theta(const optim::AngleRange& allowed) {
  return std::clamp(26 * radians_per_degree, allowed.lower, allowed.upper);
}

/// A net that folds to a solid: the search, its closed form, and the physics run of its folding.
std::unique_ptr<Goal> make_goal(FoldFile file);

/// The same of a solid whose faces are no rectangles of squares. @pre file.goal.solid
std::unique_ptr<Goal> make_solid_goal(FoldFile file);

extern const GoalKind fold_kind;

}  // namespace kinetix::app
