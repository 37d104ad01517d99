#pragma once

#include "model/hinge/elasticity.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::sim {

/// Returns the largest force that any hinge exerts by a point or by the turning spring (moment over the cell
/// edge), in units of k_point edge.
double largest_hinge_force(const model::Linkage& structure, const model::State& state,
                           const model::Stiffness& stiffness);

}  // namespace kinetix::sim
