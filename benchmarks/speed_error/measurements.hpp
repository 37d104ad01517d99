#pragma once

#include "benchmarks/speed_error/measured_scene.hpp"

namespace kinetix::bench {

/// Returns every method on every scene, measured at the first call, which takes minutes.
const std::vector<MeasuredScene>& speed_error_measurements();

}  // namespace kinetix::bench
