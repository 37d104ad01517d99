#pragma once

#include "app/run_curve.hpp"

namespace kinetix {

/// Runs the physics engine on run.structure, compares it with the reference state, and adds its state, the
/// verification and its rows of the speed-against-error table to the run. A quick run of coarser settings
/// gives a second row. Joints of nets (F4) are stiffer than the options say.
/// @param reference the state of the same drive by run.plan.model; empty where no model knows one
void verify(Run& run, const State& reference, const Drive& drive, const PhysicsOptions& options,
            const Progress& progress);

/// Row of the table for the exact model: time of one state, largest hinge gap as its error.
Fidelity exact_fidelity(const Classification& family, const Structure& structure, double theta);

/// States of the motion from flat to theta, named "frame".
std::vector<NamedState> motion_frames(const Classification& family, const Structure& structure, double theta,
                                      int count);

}  // namespace kinetix
