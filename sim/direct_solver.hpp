#pragma once

#include <memory>

class btConstraintSolver;

namespace kinetix {

/// A solver for the engine that meets all joint equations of a step at once (RowSystem), and sweeps over the
/// contacts only: every contact impulse is applied together with the answer of all joints to it. Contacts
/// are frictionless, and yield a little before the joints do: where a drive presses parts into each other,
/// they overlap, and the structure stays whole.
/// @param joint_stiffness as PhysicsOptions has it
std::unique_ptr<btConstraintSolver> make_direct_solver(double joint_stiffness);

}  // namespace kinetix
