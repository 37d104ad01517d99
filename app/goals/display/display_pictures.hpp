#pragma once

#include <vector>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Pictures of a run's panel: before.svg and .png, after, hinges (the map of t), physics where there is a
/// settled run, afar_before.png and afar_after.png (far_view), and the motion as frames/00.png and on.
std::vector<NamedContent> display_pictures(const Run& run);

}  // namespace kinetix::app
