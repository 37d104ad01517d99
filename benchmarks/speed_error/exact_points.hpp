#pragma once

#include "benchmarks/speed_error/measured_point.hpp"
#include "benchmarks/speed_error/scene.hpp"

namespace kinetix::bench {

/// Measures the closed form: one point, with the error of its rounding. Empty for a scene that has none.
MeasuredPoints exact_points(const SpeedErrorScene& scene);

/// Computes the rms distance of the closed form from itself in other arithmetic, cell edges. Sheets (F1 to F3) use
/// numbers of long double. Nets (F4) use another tree of walls, from the last body. @pre scene.is_exact()
double rounding_error(const SpeedErrorScene& scene);

}  // namespace kinetix::bench
