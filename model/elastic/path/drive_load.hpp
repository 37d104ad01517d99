#pragma once

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

/// Returns whether the turning springs are so soft that the load on the drive is below Newton's force
/// tolerance and rounding.
bool turns_softly(const ElasticSystem& system);

/// Returns the derivative of the elastic energy along the path by the drive's coordinate, in the units of
/// ElasticSystem::load. It equals the force on the driven part. Residual forces at the hinge points do no
/// work along the path. So the load of a one-degree-of-freedom sheet is accurate to the digits of its turning
/// springs, however soft they are.
/// @param state in equilibrium at theta, rad, not 0 for plates
/// @param tangent its tangent, factorised
double load_along_path(const ElasticSystem& system, const State& state, double theta,
                       const TangentStiffness& tangent);

/// Returns the derivative of the load by the drive's coordinate along the path, by central differences of
/// first-order states. In the units of ElasticSystem::load per unit of that coordinate. NaN for plates in the
/// flat state, and if rounding would dominate.
/// @param state in stable equilibrium at theta, rad
/// @param tangent its tangent, factorised
double load_stiffness(const ElasticSystem& system, const State& state, double theta,
                      const TangentStiffness& tangent);

/// Returns the load of an equilibrium: along the path if hinges turn softly, otherwise the force on the
/// driven part. For springs it is computed from their turns, which have no rounding problem.
/// @param state in equilibrium at theta, rad
/// @param tangent of the state; used and factorised only if `stable`
double drive_load(const ElasticSystem& system, const State& state, double theta,
                  const TangentStiffness& tangent, bool stable);

}  // namespace kinetix::model
