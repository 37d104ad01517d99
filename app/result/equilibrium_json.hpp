#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {

/// The section `equilibrium` of result.json.
nlohmann::ordered_json equilibrium_json(const Equilibrium& equilibrium);

/// Shape memory: of the moments by which its springs turn their hinges on, at the path's end, N mm.
double mean_moment(const Equilibrium& equilibrium);

/// Adds an equilibrium's numbers to `metrics`.
void add_equilibrium_metrics(const Equilibrium& equilibrium, nlohmann::ordered_json& metrics);

}  // namespace kinetix::app
