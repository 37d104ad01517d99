#pragma once

#include "benchmarks/speed_error/measured_scene.hpp"

namespace kinetix::bench {

/// SVG picture: error against time, both logarithmic, a panel a scene on common axes, a colour a method; the
/// front of the best settings of each is drawn as a line. Points that their method does not call a result are
/// pale.
std::string speed_error_plot(const std::vector<MeasuredScene>& scenes);

}  // namespace kinetix::bench
