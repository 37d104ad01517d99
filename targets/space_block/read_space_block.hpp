#pragma once

#include "targets/document/section.hpp"
#include "targets/space_block/space_block_goal.hpp"

namespace kinetix::targets {

/// Every key of a `target:` section of kind space_block.
const KeyTable& space_block_target_keys();

/// @throws InvalidInput for a factor or lengths out of range
SpaceBlockGoal read_space_block(const Section& target);

}  // namespace kinetix::targets
