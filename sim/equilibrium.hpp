#pragma once

#include "model/hinge/elasticity.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::sim {

/// Largest force that a point or the turning spring (as a moment over the cell edge) of any hinge exerts, in
/// units of k_point edge.
double largest_hinge_force(const model::Linkage& structure, const model::State& state,
                           const model::Stiffness& stiffness);

}  // namespace kinetix::sim
