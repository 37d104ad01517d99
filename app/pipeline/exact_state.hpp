#pragma once

#include <optional>

#include "app/files/design_file.hpp"
#include "app/run/forecast.hpp"
#include "app/run/plan.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Approximate number of states that show a motion, flat and last included: enough to see it move. Each state adds
/// all its poses to result.json.
inline constexpr int motion_states = 13;

/// Returns the state of an exact family at theta, rad, in the place where results show it. @param name of the state
/// @pre planned, exact
NamedState exact_state(const Found& found, const std::string& name, double theta);

/// Returns motion_states states of the exact motion from flat to found.theta, rad.
std::vector<NamedState> exact_frames(const Found& found);

/// Returns the table row of the exact model: time of one state, s, and as its error the largest joint separation,
/// cell edges.
/// @param theta rad
Fidelity exact_fidelity(const model::ExactMotion& exact, const model::Linkage& structure, double theta);

/// Returns the model that computes the states of a design, from the requested model. Empty: exact if a family fits,
/// otherwise bullet. Imported bodies use the requested model. A simulation of elastic hinges is compared with their
/// equilibrium.
std::optional<Model> plan_model(const Design& design, Model asked);

/// Forecasts a run of a design.
Forecast forecast_design(const Design& design);

}  // namespace kinetix::app
