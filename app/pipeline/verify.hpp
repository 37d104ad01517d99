#pragma once

#include "app/run/run_options.hpp"
#include "app/run/scene.hpp"

namespace kinetix::app {

/// Runs the physics engine on run.structure, compares it with the reference state, and adds its state, the
/// verification and its rows of the speed-against-error table to the run. A quick run of coarser settings
/// gives a second row. Joints of nets (F4) are stiffer than the options say.
void verify(Run& run, const PhysicsTask& task, const Progress& progress);

bool is_settled(const Verification& verification);

}  // namespace kinetix::app
