#pragma once

#include "app/run/run.hpp"

namespace kinetix::app {

/// About how many states of a motion a run shows, flat and last included: enough to see it move; every one
/// adds all its poses to result.json.
inline constexpr int motion_states = 13;

/// The state of an exact family where results show it: at a theta, rad. @param name of the state   @pre planned, exact
NamedState exact_state(const Found& found, const std::string& name, double theta);

/// Returns such states of its motion from flat to found.theta, rad.
std::vector<NamedState> exact_frames(const Found& found);

/// Row of the table for the exact model: time of one state, s, largest hinge gap, cell edges, as its error.
/// @param theta rad
Fidelity exact_fidelity(const model::ExactMotion& exact, const model::Linkage& structure, double theta);

}  // namespace kinetix::app
