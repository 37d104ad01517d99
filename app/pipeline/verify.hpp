#pragma once

#include "app/run/run_options.hpp"
#include "app/run/scene.hpp"

namespace kinetix::app {

/// Runs the physics engine on run.structure, compares it with the reference state, and adds its state, the
/// verification and its row of the speed-against-error table to the run. Where no step is given and there is a reference,
/// coarser steps are tried first: a run in them that settles in the reference is as good, and any other is repeated in
/// finer ones; physics.seconds counts them all. Runs of coarser steps give further rows where `fidelity` asks for them,
/// beside a run of the usual step. Joints of exact families are stiffer than the options say. A run that is
/// stopped adds nothing.
void verify(Run& run, const PhysicsTask& task, const RunOptions& options);

bool is_settled(const Verification& verification);

}  // namespace kinetix::app
