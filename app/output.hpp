#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/run.hpp"

namespace kinetix {

/// Writes DIR/result.json, DIR/design.yaml and DIR/report.html, each whole or not at all; sets
/// run.timings.write.
/// @return the JSON document. @throws InvalidInput where the folder cannot be written
nlohmann::ordered_json write_results(Run& run, const std::string& folder);

}  // namespace kinetix
