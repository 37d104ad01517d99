#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/files/design_file.hpp"

namespace kinetix::app::studio {

/// Returns the message `result` (docs/studio.md) of the result.json next to a design file: its goal and its
/// errors.
/// Null if there is no such file, it cannot be read, it had no goal, or its sheet differs: bodies or hinges
/// by more than the rounding of design files.
nlohmann::ordered_json earlier_result(const std::string& design_file, const Design& design);

/// Returns the theta of the state that the result of such a message shows, rad; empty without one.
std::optional<double> theta_reached(const nlohmann::ordered_json& message);

}  // namespace kinetix::app::studio
