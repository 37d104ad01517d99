#pragma once

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// The state after every body has followed its twist (rows 6b.. of `twists` as in model/closure/closure.hpp:
/// turn, rad, then shift of its position, cell edges) for one unit along the screw motion that starts so:
/// positions go along arcs, not straight on. To first order the same as retract_straight() of model/closure/closure.hpp;
/// long chains of bodies that turn together stay closed far better.
State retract(const Linkage& structure, const State& state, const Eigen::VectorXd& twists);

}  // namespace kinetix::model
