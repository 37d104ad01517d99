#pragma once

#include <memory>

class btConstraintSolver;

namespace kinetix::sim {

/// The engine's sequential-impulse solver, which goes over the joints to and fro in the order in which they
/// were added to the world. The stock solver always goes in one direction, and in an order that a quick sort
/// by island scrambles: along a chain, a correction then travels one joint per round instead of the whole
/// chain.
std::unique_ptr<btConstraintSolver> make_sequential_impulses();

}  // namespace kinetix::sim
