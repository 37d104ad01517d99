#pragma once

#include <nlohmann/json.hpp>

#include "app/run.hpp"

namespace kinetix {

/// The section `physics` of result.json.
nlohmann::ordered_json physics_json(const Verification& verification);

}  // namespace kinetix
