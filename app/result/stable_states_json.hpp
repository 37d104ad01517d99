#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Adds stable_states, energy_barriers and unresolved_releases to the section `equilibrium` of result.json.
/// @pre run.equilibrium
void add_stable_states(const Run& run, nlohmann::ordered_json& equilibrium);

}  // namespace kinetix::app
