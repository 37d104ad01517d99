#pragma once

#include "benchmarks/speed_error/measured_scene.hpp"

namespace kinetix::bench {

/// Every method on every scene, measured at the first call: minutes.
const std::vector<MeasuredScene>& speed_error_measurements();

}  // namespace kinetix::bench
