#pragma once

#include "benchmarks/speed_error/measured_scene.hpp"

namespace kinetix::bench {

/// Draws an SVG picture of error against time, both logarithmic. It has one panel per scene on common axes, and one
/// colour per method. A line joins the front of each method's best settings. Points that their method does not call a
/// result are pale.
std::string speed_error_plot(const std::vector<MeasuredScene>& scenes);

}  // namespace kinetix::bench
