#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// The section `equilibrium` of result.json.
nlohmann::ordered_json equilibrium_json(const Equilibrium& equilibrium);

/// Shape memory: of the moments by which its springs turn their hinges on, at the path's end, N mm.
double mean_moment(const Equilibrium& equilibrium);

/// Adds an equilibrium's numbers to `metrics`.
void add_equilibrium_metrics(const Equilibrium& equilibrium, nlohmann::ordered_json& metrics);

/// The section `matter` of result.json. @pre run.matter
nlohmann::ordered_json matter_json(const MatterResult& matter);

/// How far elastic hinges are from the goal, before and after the design makes up for them. None without.
std::vector<SummaryLine> matter_lines(const Run& run);

}  // namespace kinetix::app
