#pragma once

#include <vector>

#include "app/pictures/far_view.hpp"
#include "app/run/run.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::app {

/// Pictures of a run's panel: before.svg and .png, after, hinges (the map of t), physics where there is a
/// settled run, afar_before.png and afar_after.png (far_view) in true luminance, the same with `_enhanced` and stretched
/// contrast, and the motion as frames/00.png and on.
std::vector<NamedContent> display_pictures(const Run& run);

/// How the panel of a goal is to be seen from a distance: the further away the more cells it has, and against its
/// surroundings where it has many, as an eye adapts to the light of a large panel.
FarViewOptions far_view_options(const targets::DisplayGoal& goal);
/// The four pictures from a distance alone.
std::vector<NamedContent> far_pictures(const Run& run);

}  // namespace kinetix::app
