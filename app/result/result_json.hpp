#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {

/// The document of formats.md, schema kinetix-result/1 (app/schema/result.schema.json): millimetres, and
/// radians where a key ends in _rad. Numbers that are not finite become null.
nlohmann::ordered_json result_json(const Run& run);
/// Its key `metrics` alone.
nlohmann::ordered_json metrics_json(const Run& run);

/// The few lines of it that a person reads on stdout.
std::string summary(const Run& run);

/// Returns the section `structure`. @param reach_mm of hinges that do not define theirs   @param elasticity defines the reach of all
nlohmann::ordered_json structure_json(const Design& design, double reach_mm,
                                      const model::Elasticity* elasticity = nullptr);

}  // namespace kinetix::app
