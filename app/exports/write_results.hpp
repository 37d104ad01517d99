#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Writes DIR/result.json and what the exporters make of the run (app/exports/registry.hpp), all of them or
/// none, and removes what an earlier run left there beside what every run writes; sets run.timings.write. A design.yaml there
/// that somebody has changed since a run wrote it stays, under the name that run.kept_design then is.
/// @return the JSON document. @throws InvalidInput where the folder cannot be written
nlohmann::ordered_json write_results(Run& run, const std::string& folder);

}  // namespace kinetix::app
