#pragma once

#include <Eigen/Core>

#include "targets/document/section.hpp"

namespace kinetix::targets {

/// A block that shrinks in all three directions at once.
struct SpaceBlockGoal {
  Eigen::Vector3d factors = {0.85, 0.85,
                             0.85};  ///< lengths when it is pressed over those at rest, x, y, z, (0, 1)
  std::optional<Eigen::Vector3d> size_mm = {};  ///< at rest, along x, y and z, > 0; nothing: any
};

/// Points on the six sides of a block: two sides a direction, the lower one first. mm
using BlockSides = std::array<std::array<std::vector<Eigen::Vector3d>, 2>, 3>;

/// Lengths between the middles of opposite sides, along x, y and z, mm. @pre every side has a point
Eigen::Vector3d block_lengths(const BlockSides& sides);

/// How a block that was pressed differs from its goal.
struct SpaceBlockError {
  Eigen::Vector3d factors = {0, 0, 0};  ///< lengths over those at rest, along x, y and z, ratios
  double off = 0;                       ///< the largest difference of one from the goal's, of a ratio
};

/// @param rest lengths, mm, > 0   @param pressed lengths, mm
SpaceBlockError space_block_error(const SpaceBlockGoal& goal, const Eigen::Vector3d& rest,
                                  const Eigen::Vector3d& pressed);

/// Every key of a `target:` section of kind space_block.
const KeyTable& space_block_target_keys();

/// @throws InvalidInput for a factor or lengths out of range
SpaceBlockGoal read_space_block(const Section& target);

}  // namespace kinetix::targets
