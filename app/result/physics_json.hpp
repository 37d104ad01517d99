#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {

/// The section `physics` of result.json.
nlohmann::ordered_json physics_json(const Verification& verification);

}  // namespace kinetix::app
