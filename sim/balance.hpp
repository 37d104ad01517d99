#pragma once

#include "model/elastic/elasticity.hpp"
#include "model/state.hpp"

namespace kinetix {

/// Largest force that a point or the turning spring (as a moment over the cell edge) of any hinge exerts, in
/// units of k_point edge.
double largest_hinge_force(const Structure& structure, const State& state, const Stiffness& stiffness);

}  // namespace kinetix
