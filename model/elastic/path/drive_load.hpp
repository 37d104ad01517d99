#pragma once

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

/// Whether the turning springs of a structure are so soft that Newton's tolerance on forces, and what
/// rounding leaves of them, drown the load on the drive.
bool turns_softly(const ElasticSystem& system);

/// Change of the elastic energy along the path, by the drive's coordinate, in the units of
/// ElasticSystem::load, which is the force on what is driven. Forces that are left at the hinge points do no
/// work along the path, so that the load of a sheet that moves exactly is right to the digits of its turning
/// springs, however soft they are.
/// @param state in equilibrium at theta, rad, not 0 for plates  @param tangent its tangent, factorised
double load_along_path(const ElasticSystem& system, const State& state, double theta,
                       const TangentStiffness& tangent);

/// Derivative of the load by the drive's coordinate along the path, in the units of ElasticSystem::load by that coordinate; NaN
/// for plates in the flat state and where rounding would drown it. By central differences of first-order states.
/// @param state in stable equilibrium at theta, rad  @param tangent its tangent, factorised
double load_stiffness(const ElasticSystem& system, const State& state, double theta,
                      const TangentStiffness& tangent);

/// The load of an equilibrium: along the path where hinges turn softly, else the force on what is driven. That of springs
/// comes from their turns, which rounding leaves alone.
/// @param state in equilibrium at theta, rad
/// @param tangent of it; used where `stable`: then it is factorised
double drive_load(const ElasticSystem& system, const State& state, double theta,
                  const TangentStiffness& tangent, bool stable);

}  // namespace kinetix::model
