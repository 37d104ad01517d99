#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// The section `matter` of result.json. @pre run.matter
nlohmann::ordered_json matter_json(const MatterResult& matter);

/// How far elastic hinges are from the goal, before and after the design makes up for them. None without.
std::vector<SummaryLine> matter_lines(const Run& run);

}  // namespace kinetix::app
