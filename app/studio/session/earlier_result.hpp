#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/files/design_file.hpp"

namespace kinetix::app::studio {

/// The message `result` (docs/studio.md) of the result.json that lies beside a design file: its goal and its errors. Null
/// where there is none, it cannot be read, it had no goal, or its sheet is another one: bodies or hinges that differ by more
/// than design files round.
nlohmann::ordered_json earlier_result(const std::string& design_file, const Design& design);

/// Of such a message: theta of the state that the result shows, rad; nothing where there is none.
std::optional<double> theta_reached(const nlohmann::ordered_json& message);

}  // namespace kinetix::app::studio
