#pragma once

#include <Eigen/SparseCore>
#include <variant>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A drive that turns the upper body of a hinge about the hinge axis, relative to the lower body. On the
/// y-wall of body (0, 0), the fold parameter theta is the angle -2 theta.
struct HingeTurn {
  int hinge = 0;
  double angle = 0;  ///< rad, (-pi, pi)

  bool operator==(const HingeTurn&) const = default;
};

/// A drive that prescribes the motion of one body since `from` along one direction:
/// direction.omega . (turn since from, rad) + direction.v . (shift since from, in cell edges) = amount.
struct BodyPush {
  int body = 0;
  Pose from;
  Twist direction;    ///< v in cell edges; not zero
  double amount = 0;  ///< rad and cell edges; the turn that results must stay below pi
};

/// Scalar condition that drives a structure.
using ClosureDrive = std::variant<HingeTurn, BodyPush>;

/// @throws InvalidInput for a body or hinge that does not exist, or numbers out of range
void validate(const ClosureDrive& drive, const Linkage& structure);

/// Returns the turn of a hinge in a state, rad, (-pi, pi].
double hinge_turn(const Linkage& structure, const State& state, int hinge);
/// Returns the largest difference of a hinge's turn between two states, rad. The differences do not add up
/// along chains.
double turn_distance(const Linkage& structure, const State& a, const State& b);

/// Returns the deviation of the state from the drive's target, rad or cell edges.
double drive_residual(const ClosureDrive& drive, const Linkage& structure, const State& state);

/// Appends the derivative of drive_residual by the bodies' twists (rad, cell edges; columns as in
/// closure.hpp) as row `row`.
void append_drive_gradient(const ClosureDrive& drive, const Linkage& structure, const State& state, int row,
                           std::vector<Eigen::Triplet<double>>& entries);

}  // namespace kinetix::model
