#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Returns the section `equilibrium` of result.json.
nlohmann::ordered_json equilibrium_json(const Equilibrium& equilibrium);

/// Returns the mean moment of shape-memory springs at the end of the path, N mm.
double mean_moment(const Equilibrium& equilibrium);

/// Adds an equilibrium's numbers to `metrics`.
void add_equilibrium_metrics(const Equilibrium& equilibrium, nlohmann::ordered_json& metrics);

/// Returns the section `matter` of result.json.
nlohmann::ordered_json matter_json(const ElasticResult& matter);

/// Returns the summary lines of the compensation for elastic hinges: distance from the goal before and after it. Empty
/// without run.matter.
std::vector<SummaryLine> matter_lines(const Run& run);

}  // namespace kinetix::app
