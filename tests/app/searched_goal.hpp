#pragma once

#include <nlohmann/json.hpp>

#include "app/pipeline/pipeline.hpp"
#include "app/result/result_json.hpp"

namespace kinetix::testing {

/// Searches for a goal and measures the state of its design. Leaves out what a run does besides: it compensates for
/// elastic hinges, simulates, and checks prints, contact and export.
inline app::Run searched_goal(const app::Goal& goal, const app::RunOptions& options = {}) {
  return held(goal.search(options), &goal, options);
}

/// Returns the result.json of a run that writes no files.
inline nlohmann::json unwritten_result(const app::Run& run) {
  return nlohmann::json::parse(result_json(run).dump());
}

}  // namespace kinetix::testing
