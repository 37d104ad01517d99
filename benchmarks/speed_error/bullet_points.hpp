#pragma once

#include "benchmarks/speed_error/measured_point.hpp"
#include "benchmarks/speed_error/scene.hpp"

namespace kinetix::bench {

/// Measures the physics run over stiffnesses of joints and time steps, in the precision of the engine that the program
/// is linked with. Times are those of the steps alone, without the preparation before the first of them.
MeasuredPoints bullet_points(const SpeedErrorScene& scene);

}  // namespace kinetix::bench
