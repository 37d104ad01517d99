#pragma once

#include <nlohmann/json.hpp>

#include "app/run.hpp"

namespace kinetix {

/// The section `equilibrium` of result.json.
nlohmann::ordered_json equilibrium_json(const Equilibrium& balance);

/// Adds an equilibrium's numbers to `metrics`.
void add_equilibrium_metrics(const Equilibrium& balance, nlohmann::ordered_json& metrics);

}  // namespace kinetix
