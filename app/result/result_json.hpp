#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Returns result.json, schema kinetix-result/1 (formats.md, app/schema/result.schema.json). Lengths are in mm, and
/// keys that end in _rad are in radians. Numbers that are not finite become null.
nlohmann::ordered_json result_json(const Run& run);
/// Returns only the section `metrics`.
nlohmann::ordered_json metrics_json(const Run& run);

/// Returns the summary of a run for stdout.
std::string summary(const Run& run);

/// Returns the section `structure`. @param reach_mm reach of hinges without their own value
/// @param elasticity if given, defines the reach of all hinges
nlohmann::ordered_json structure_json(const Design& design, double reach_mm,
                                      const model::Elasticity* elasticity = nullptr);

}  // namespace kinetix::app
