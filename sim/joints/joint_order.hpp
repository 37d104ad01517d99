#pragma once

class btDiscreteDynamicsWorld;
class btTypedConstraint;

namespace kinetix::sim {

/// Sets the engine up to solve all joints together, in the order in which they are added, afresh every step.
/// @param iterations rounds of sequential impulses per step
void prepare_for_joints(btDiscreteDynamicsWorld& world, int iterations);

/// Adds a joint after those that are there; sequential impulses go by this order.
void add_in_order(btDiscreteDynamicsWorld& world, btTypedConstraint& joint);

}  // namespace kinetix::sim
