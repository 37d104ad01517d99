#pragma once

#include <nlohmann/json.hpp>

#include "model/state.hpp"

namespace kinetix {

/// The poses of a state as result.json has them.
nlohmann::ordered_json poses_json(const State& state);

}  // namespace kinetix
