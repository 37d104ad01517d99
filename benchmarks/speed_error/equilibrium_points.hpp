#pragma once

#include "benchmarks/speed_error/measured_point.hpp"
#include "benchmarks/speed_error/scene.hpp"

namespace kinetix::bench {

/// Measures the elastic equilibrium followed from flat. A scene with a closed form varies the stiffness ratio k_turn /
/// (k_point L^2). Others vary the tolerance of Newton's method and the step of the path.
MeasuredPoints equilibrium_points(const SpeedErrorScene& scene);

/// Makes the equilibrium at the tightest tolerance and the shortest steps the reference of a scene. Its error is the
/// change since steps twice as long. @throws std::runtime_error if the path ends early
void set_finest_equilibrium(SpeedErrorScene& scene);

}  // namespace kinetix::bench
