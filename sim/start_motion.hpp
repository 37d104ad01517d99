#pragma once

#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::sim {

/// Returns the first-order motion of the flat structure nearest to planar folding: sublattice A turning about
/// z at unit speed, sublattice B at minus that. Bodies started in this way leave flat on the branch of
/// positive theta without a jolt. Spins alone would not do for a long strip, whose tilted walls must lift its
/// far end at once.
/// @return one twist per body, v in cell edges; the bare spins if the structure has no first-order motion
/// near them
std::vector<model::Twist> start_motion(const model::Linkage& structure);

/// Adds a random motion to each body's: up to `by` in each direction, rad and cell edges. If planar, only
/// turns about z and shifts in the plane. The same seed gives the same motion.
void disturb(std::vector<model::Twist>& motion, double by, unsigned seed, bool planar);

}  // namespace kinetix::sim
