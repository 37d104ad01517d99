#pragma once

#include "model/linkage/state.hpp"
#include "model/matter/made_hinge.hpp"

namespace kinetix::model {

/// Largest strain of a block or film as its two bodies hold it in a state: of its bending (strain()), and what its upper or lower
/// edge, half its height from the middle, is pulled apart or pressed together by over its gap. 0 of a pin.
double hinge_strain(const MadeHinge& made, const Linkage& linkage, const State& state, int hinge);

}  // namespace kinetix::model
