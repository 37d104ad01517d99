#pragma once

#include "model/elastic/equilibrium_path.hpp"

namespace kinetix::model {

/// The steps of a path at which its load has a maximum or a minimum, as events in the order of the path; the
/// ends do not count. A maximum stands out where the load falls on both sides of it, before it rises above it
/// again, by at least `prominence` times the span of all loads; a minimum likewise.
std::vector<PathEvent> limit_points(const EquilibriumPath& path, double prominence = 0.02);

/// Adds them to the path's events, which stay in the order of the path.
void add_limit_points(EquilibriumPath& path);

}  // namespace kinetix::model
