#pragma once

#include "benchmarks/speed_error/measured_point.hpp"
#include "benchmarks/speed_error/scene.hpp"

namespace kinetix::bench {

/// The closed form: one point, with the error of its rounding. Empty for a scene that has none.
MeasuredPoints exact_points(const SpeedErrorScene& scene);

/// Rms distance of the closed form from itself in other arithmetic, cell edges: sheets (F1 to F3) in the
/// numbers of long double, nets (F4) along another tree of walls, from the last body. @pre scene.is_exact()
double rounding_error(const SpeedErrorScene& scene);

}  // namespace kinetix::bench
