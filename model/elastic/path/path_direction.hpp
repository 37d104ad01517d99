#pragma once

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

/// How a state changes by theta along its path of equilibrium: all coordinates, rad and cell edges by rad;
/// zero for what the drive holds or moves by itself (ElasticSystem::place_rate).
/// @param state in equilibrium at theta, rad  @param tangent its tangent, factorised
/// @param placed_at theta of the rate at which plates move and a cord shortens, rad: they stand still to first order where
/// they start
Eigen::VectorXd path_direction(const ElasticSystem& system, const State& state, double theta,
                               double placed_at, const TangentStiffness& tangent, int refined = 0);

}  // namespace kinetix::model
