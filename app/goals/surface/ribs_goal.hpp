#pragma once

#include "app/goals/surface/ribs_file.hpp"
#include "app/run/goal.hpp"

namespace kinetix::app {

/// A fishbone over a surface: layout, fit of all tilts and theta, the same ribs loose for comparison, and the physics
/// run of its folding. All states are in the frame of the mesh, mm.
std::unique_ptr<Goal> make_goal(RibsFile file);

}  // namespace kinetix::app
