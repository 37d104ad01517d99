#pragma once

#include <nlohmann/json_fwd.hpp>

#include "model/linkage/state.hpp"

namespace kinetix::app {

/// The poses of a state as result.json has them.
nlohmann::ordered_json poses_json(const model::State& state);

}  // namespace kinetix::app
