#pragma once

#include "benchmarks/speed_error/measured_scene.hpp"

namespace kinetix::bench {

/// Writes a Markdown table of each method at an error of 1 %, 0.1 % and 0.01 % of a cell edge. It gives the time and
/// setting of its fastest point, and the ratio against the fastest method of the scene. A point counts by its error,
/// whatever its method reports.
std::string speed_error_table(const std::vector<MeasuredScene>& scenes);

/// Describes in one sentence by how much the repeats of one setting differ.
std::string spread_sentence(const std::vector<MeasuredScene>& scenes);

}  // namespace kinetix::bench
