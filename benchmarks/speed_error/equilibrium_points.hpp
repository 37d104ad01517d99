#pragma once

#include "benchmarks/speed_error/measured_point.hpp"
#include "benchmarks/speed_error/scene.hpp"

namespace kinetix::bench {

/// The elastic equilibrium followed from flat. For a scene with a closed form over the stiffness ratio
/// k_turn / (k_point L^2), for others over the tolerance of Newton's method and the step of the path.
MeasuredPoints equilibrium_points(const SpeedErrorScene& scene);

/// Makes the equilibrium at the tightest tolerance and the shortest steps the reference of a scene, and what
/// changed since steps twice as long its error. @throws std::runtime_error where the path ends early
void set_finest_equilibrium(SpeedErrorScene& scene);

}  // namespace kinetix::bench
