#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/run.hpp"

namespace kinetix {

/// The section `helmet` of result.json: ribs, distances of bodies and cells, the helmet of one tilt, reasons.
nlohmann::ordered_json helmet_json(const Run& run);
/// The section `target`: the curves that spine and ribs are to follow, in the mesh's frame, mm.
nlohmann::ordered_json helmet_target_json(const HelmetOutcome& helmet);
/// The section `optimiser`.
nlohmann::ordered_json helmet_optimiser_json(const HelmetOutcome& helmet);
/// Adds a helmet's numbers to `metrics`.
void add_helmet_metrics(const HelmetOutcome& helmet, nlohmann::ordered_json& metrics);
/// What the summary says: lines of a label and a text.
std::vector<std::array<std::string, 2>> helmet_lines(const Run& run);

}  // namespace kinetix
