#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Returns the residual of the closure conditions in any state, in six coordinates per body. It is
/// independent of the exact families.
/// Each hinge has six rows. Three are the mismatch of the hinge point, lower body minus upper body, in cell
/// edges. Three are the mismatch of the unit hinge axis. A small mismatch of the axis is in the plane normal
/// to it, so that five of the six rows count.
/// @pre state.size() == structure.bodies.size()
Eigen::VectorXd closure_residual(const Linkage& structure, const State& state);

/// Returns the derivative of closure_residual with respect to the bodies' twists, as entries or as a matrix.
/// Columns 6b..6b+2 are a turn omega of body b about its position (dR = [omega]x R, rad). Columns 6b+3..6b+5
/// are a shift of its position in cell edges.
std::vector<Eigen::Triplet<double>> closure_entries(const Linkage& structure, const State& state);
Eigen::SparseMatrix<double> closure_jacobian(const Linkage& structure, const State& state);

/// Returns the state (mm) after every body turns by exp(omega) and shifts in a straight line. `twists` has
/// the order of the columns above. model/elastic/retract.hpp has the retract along screws.
State retract_straight(const Linkage& structure, const State& state, const Eigen::VectorXd& twists);

}  // namespace kinetix::model
