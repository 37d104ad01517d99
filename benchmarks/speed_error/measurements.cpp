#include "benchmarks/speed_error/measurements.hpp"

#include <iostream>

#include "benchmarks/speed_error/bullet_points.hpp"
#include "benchmarks/speed_error/child_output.hpp"
#include "benchmarks/speed_error/equilibrium_points.hpp"
#include "benchmarks/speed_error/exact_points.hpp"
#include "benchmarks/speed_error/point_lines.hpp"

namespace kinetix::bench {
namespace {

using Method = MeasuredPoints (*)(const SpeedErrorScene&);

/// In the order of legend and table. A peer joins here, with a style in series_style.cpp.
constexpr Method methods[] = {exact_points, equilibrium_points, bullet_points};

MeasuredScene measured(const SpeedErrorScene& scene) {
  MeasuredScene result{scene.name, scene.is_exact(), scene.reference_error};
  for (const Method method : methods)
    for (MeasuredPoint& point : method(scene)) result.points.push_back(std::move(point));
  std::cerr << "speed against error: " << scene.name << ", " << result.points.size() << " points"
            << std::endl;
  return result;
}

/// Adds the engine in single precision, measured by a separate program.
void add_single_precision(std::vector<MeasuredScene>& scenes) {
  for (const std::string& line : lines_printed_by(KINETIX_SPEED_ERROR_SINGLE)) {
    SceneAndPoint found = from_line(line);
    for (MeasuredScene& scene : scenes)
      if (scene.name == found.scene) scene.points.push_back(std::move(found.point));
  }
}

std::vector<MeasuredScene> measure_all() {
  std::vector<MeasuredScene> scenes;
  for (const SpeedErrorScene& scene : speed_error_scenes()) scenes.push_back(measured(scene));
  add_single_precision(scenes);
  return scenes;
}

}  // namespace

const std::vector<MeasuredScene>& speed_error_measurements() {
  static const std::vector<MeasuredScene> scenes = measure_all();
  return scenes;
}

}  // namespace kinetix::bench
