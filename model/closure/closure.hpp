#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// The closure conditions of a structure as a system of equations in six coordinates per body, independent of
/// the exact families. Six rows a hinge: mismatch of the hinge point as carried by its lower and its upper
/// body (lower - upper, in cell edges), then likewise of the unit hinge axis. Small mismatches of the axis
/// lie in the plane normal to it, so that five of the six rows count.
/// @pre state.size() == structure.bodies.size()
Eigen::VectorXd closure_residual(const Linkage& structure, const State& state);

/// Derivative of closure_residual with respect to the bodies' twists: columns 6b..6b+2 for a turn omega of
/// body b about its position (dR = [omega]x R, rad), 6b+3..6b+5 for a shift of its position in cell edges.
/// As entries, or as a matrix.
std::vector<Eigen::Triplet<double>> closure_entries(const Linkage& structure, const State& state);
Eigen::SparseMatrix<double> closure_jacobian(const Linkage& structure, const State& state);

/// A retract: the state (mm) after every body has turned by exp(omega) and shifted straight on, `twists` in the
/// columns' order above. model/elastic/retract.hpp has the one along screws.
State retract_straight(const Linkage& structure, const State& state, const Eigen::VectorXd& twists);

}  // namespace kinetix::model
