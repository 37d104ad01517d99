#pragma once

#include <optional>

#include "app/files/design_file.hpp"
#include "app/run/forecast.hpp"
#include "app/run/plan.hpp"

namespace kinetix::app {

/// The model that computes the states of a design, by the model that is asked for; nothing: exact where a family fits, else
/// bullet; of imported bodies as asked. A physics run of elastic hinges is compared with their equilibrium.
std::optional<Model> plan_model(const Design& design, Model asked);

/// Forecasts a run of a design.
Forecast forecast_design(const Design& design);

}  // namespace kinetix::app
