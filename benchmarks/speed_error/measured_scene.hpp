#pragma once

#include <string>
#include <vector>

#include "benchmarks/speed_error/measured_point.hpp"

namespace kinetix::bench {

/// All points of a scene, grouped by method, the exact model's first where there is one.
struct MeasuredScene {
  std::string name;
  bool is_exact = false;       ///< errors are against the closed form; else against the finest equilibrium
  double reference_error = 0;  ///< of that reference itself, cell edges
  MeasuredPoints points = {};
};

}  // namespace kinetix::bench
