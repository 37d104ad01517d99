#pragma once

#include "app/run/run_options.hpp"
#include "app/run/scene.hpp"

namespace kinetix::app {

/// Runs the physics engine on run.structure, compares it with the reference state, and adds its state, the
/// verification and its row of the speed-against-error table to the run; runs of coarser steps give further rows where
/// `fidelity` asks for them. Joints of nets (F4) and creased sheets are stiffer than the options say. A run that is
/// stopped adds nothing.
void verify(Run& run, const PhysicsTask& task, const RunOptions& options);

bool is_settled(const Verification& verification);

}  // namespace kinetix::app
