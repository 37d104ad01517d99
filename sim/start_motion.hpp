#pragma once

#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::sim {

/// First-order motion of the flat structure that comes closest to planar folding: class A turning about z at
/// unit speed, class B at minus that. Bodies started this way leave flat on the branch of positive theta
/// without a jolt; spins alone would not carry a long strip along whose tilted walls must lift its far end at
/// once.
/// @return one twist per body, v in cell edges; the bare spins where the structure has no first-order motion
/// near them
std::vector<model::Twist> start_motion(const model::Linkage& structure);

/// Adds a random motion to each body's: up to `by` in each direction, rad and cell edges. Planar: turns about z and
/// shifts in the plane alone. The same seed adds the same.
void disturb(std::vector<model::Twist>& motion, double by, unsigned seed, bool planar);

}  // namespace kinetix::sim
