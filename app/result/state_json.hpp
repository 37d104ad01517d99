#pragma once

#include <nlohmann/json_fwd.hpp>

#include "model/linkage/state.hpp"

namespace kinetix::app {

/// The poses of a state as result.json has them.
nlohmann::ordered_json poses_json(const model::State& state);

/// [[x, y], ...], as a list.
nlohmann::ordered_json points_json(const std::vector<Eigen::Vector2d>& points);

/// [x, y, z].
nlohmann::ordered_json point_json(const Eigen::Vector3d& point);

}  // namespace kinetix::app
