#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/run.hpp"

namespace kinetix {

/// The section `fold` of result.json: faces and creases on the lattice with their angles and errors,
/// unfoldings tried, reasons.
nlohmann::ordered_json fold_json(const Run& run);
/// The section `target`: the net that was folded, as faces and creases; the box where one was asked for.
nlohmann::ordered_json fold_target_json(const FoldOutcome& fold);
/// The section `optimiser`.
nlohmann::ordered_json fold_optimiser_json(const FoldOutcome& fold);
/// Adds a fold's numbers to `metrics`: fold_deg of each crease, face_rms, and both of the physics run.
void add_fold_metrics(const FoldOutcome& fold, nlohmann::ordered_json& metrics);
/// What the summary says: lines of a label and a text.
std::vector<std::array<std::string, 2>> fold_lines(const Run& run);

}  // namespace kinetix
