#pragma once

#include "benchmarks/speed_error/measured_point.hpp"

namespace kinetix::bench {

/// Writes a point of a scene as one line without its end: fields separated by tabs, numbers to their last bit.
/// @pre no field holds a tab or the end of a line
std::string to_line(const std::string& scene, const MeasuredPoint& point);

struct SceneAndPoint {
  std::string scene;
  MeasuredPoint point;
};

/// Reads a point from a line of to_line. @throws std::runtime_error for anything else, with the line
SceneAndPoint from_line(const std::string& line);

}  // namespace kinetix::bench
