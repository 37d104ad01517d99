#pragma once

#include <optional>

#include "app/files/design_file.hpp"
#include "app/run/forecast.hpp"
#include "app/run/plan.hpp"
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

/// The model that computes the states of a design, by the model that is asked for; nothing: exact where a family fits, else
/// bullet; of imported bodies as asked. A physics run of elastic hinges is compared with their equilibrium.
std::optional<Model> plan_model(const Design& design, Model asked);

/// Forecasts a run of a design.
Forecast forecast_design(const Design& design);

}  // namespace kinetix::app
