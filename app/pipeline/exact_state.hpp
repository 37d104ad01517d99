#pragma once

#include "app/run/run.hpp"
#include "app/run/scene.hpp"

namespace kinetix::app {

/// About how many states of a motion a run shows, flat and last included: enough to see it move; every one
/// adds all its poses to result.json.
inline constexpr int motion_states = 13;

/// @throws InvalidInput where the plan knows no closed form @pre planned
void require_exact(const Run& run);

/// Adds the closed form's state at theta, rad, and its row of the speed-against-error table; sets run.theta.
/// @throws InvalidInput where there is no closed form @pre planned
void add_exact_state(Run& run, double theta);

/// Adds states of the closed form's motion from flat to run.theta.
void add_exact_frames(Run& run);

/// The physics run that folds the sheet to run.theta, to be compared with the first of its states.
PhysicsTask folding_task(const Run& run);

/// Row of the table for the exact model: time of one state, s, largest hinge gap, cell edges, as its error.
/// @param theta rad
Fidelity exact_fidelity(const model::ExactMotion& exact, const model::Linkage& structure, double theta);

}  // namespace kinetix::app
