#pragma once

#include <vector>

#include "app/pictures/far_view.hpp"
#include "app/run/run.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::app {

/// Draws the pictures of a run's panel. `before`, `after` and `hinges` (the map of t) are .svg and .png, and so is
/// `physics` if a simulation settled. `afar_before.png` and `afar_after.png` (far_view) are in true luminance. Names
/// with `_enhanced` have stretched contrast. The motion is in `frames/00.png` and on.
std::vector<NamedContent> display_pictures(const Run& run);

/// Returns the settings of the view from a distance. Panels with more cells are seen from further away. Large panels
/// are seen with their surroundings, because an eye adapts to the light of a large panel.
FarViewOptions far_view_options(const targets::DisplayGoal& goal);
/// Draws only the four pictures from a distance.
std::vector<NamedContent> far_pictures(const Run& run);

}  // namespace kinetix::app
