#pragma once

#include <optional>
#include <vector>

#include "benchmarks/speed_error/measured_point.hpp"

namespace kinetix::bench {

/// Returns the points that no other point beats or equals in time and error at once, from fast to accurate: error
/// falls as time grows. Points without a finite, positive time and a finite error are left out.
MeasuredPoints pareto_front(const MeasuredPoints& points);

/// Returns the fastest of the points whose error is at most `error`; empty if there is none.
std::optional<MeasuredPoint> fastest_at(const MeasuredPoints& points, double error);

/// The points of one legend entry.
MeasuredPoints of_series(const MeasuredPoints& points, const std::string& series);

/// The points of the engine in any setting, and all the others.
MeasuredPoints of_bullet(const MeasuredPoints& points);
MeasuredPoints without_bullet(const MeasuredPoints& points);

/// Legend entries in the order in which they first occur.
std::vector<std::string> series_in(const MeasuredPoints& points);

}  // namespace kinetix::bench
