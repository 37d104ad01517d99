#pragma once

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

/// Returns the derivative of a state by theta along its equilibrium path: all coordinates, rad and cell edges
/// per rad. It is zero for coordinates that the drive holds or moves itself (ElasticSystem::place_rate).
/// @param state in equilibrium at theta, rad.
/// @param tangent its tangent, factorised
/// @param placed_at theta, rad, for the speed of plates and tendons: in the flat state this speed is 0 to
///   first order
Eigen::VectorXd path_direction(const ElasticSystem& system, const State& state, double theta,
                               double placed_at, const TangentStiffness& tangent, int refined = 0);

}  // namespace kinetix::model
