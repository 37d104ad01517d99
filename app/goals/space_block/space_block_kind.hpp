#pragma once

#include "app/goals/space_block/space_block_file.hpp"
#include "app/run/goal_kind.hpp"

namespace kinetix::app {

/// A block of rotors and gussets that shrinks in all directions at once: the lattice, its closed form, and the physics run
/// between plates.
std::unique_ptr<Goal> make_goal(SpaceBlockFile file);

extern const GoalKind space_block_kind;

}  // namespace kinetix::app
