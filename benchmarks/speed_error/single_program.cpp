#include <iostream>

#include "benchmarks/speed_error/bullet_points.hpp"
#include "benchmarks/speed_error/point_lines.hpp"

/// Measures the physics run on every scene, in the precision it is linked with, and prints a line a point
/// (point_lines.hpp). The engine's two precisions have the same symbols: one program holds one of them.
int main(int argc, char** argv) {
  using namespace kinetix::bench;
  const std::string only = argc > 1 ? argv[1] : "";
  for (const SpeedErrorScene& scene : speed_error_scenes()) {
    if (scene.name.find(only) == std::string::npos) continue;
    for (const MeasuredPoint& point : bullet_points(scene))
      std::cout << to_line(scene.name, point) << std::endl;
  }
}
