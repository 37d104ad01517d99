#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/run.hpp"

namespace kinetix {

/// The section `display` of result.json: channel, levels and readings of all cells in the order of
/// structure.cells, starts, reasons.
nlohmann::ordered_json display_json(const Run& run);
/// The section `target`: the picture as rows, top row first.
nlohmann::ordered_json display_target_json(const DisplayOutcome& display);
/// The section `optimiser`.
nlohmann::ordered_json display_optimiser_json(const DisplayOutcome& display);
/// Adds a display's numbers to `metrics`.
void add_display_metrics(const DisplayOutcome& display, nlohmann::ordered_json& metrics);
/// What the summary says: lines of a label and a text.
std::vector<std::array<std::string, 2>> display_lines(const Run& run);

/// Pictures of a run's panel as name and content: before.svg and .png, after, hinges (the map of t), physics
/// where there is a settled run, afar_before.png and afar_after.png (far_view), and the motion as frames/00.png
/// and on.
std::vector<std::pair<std::string, std::string>> display_pictures(const Run& run);

}  // namespace kinetix
