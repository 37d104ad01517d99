#pragma once

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Returns the state after every body has moved for one unit along the screw motion of its twist. Rows 6b..
/// of `twists` have the turn, rad, and the shift of the position, cell edges, as in
/// model/closure/closure.hpp. Positions move along arcs. To first order this equals retract_straight() of
/// model/closure/closure.hpp, but long chains of bodies that turn together stay closed far better.
State retract(const Linkage& structure, const State& state, const Eigen::VectorXd& twists);

}  // namespace kinetix::model
