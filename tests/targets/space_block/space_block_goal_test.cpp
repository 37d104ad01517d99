#include "targets/space_block/space_block_goal.hpp"

#include <gtest/gtest.h>

namespace kinetix::targets {
namespace {

TEST(SpaceBlockGoal, MeasuresLengthsBetweenTheMiddlesOfSides) {
  BlockSides sides;
  for (int d = 0; d < 3; ++d) {
    sides[d][0] = {Eigen::Vector3d::Constant(1), Eigen::Vector3d::Constant(3)};
    sides[d][1] = {Eigen::Vector3d::Constant(10 + d)};
  }
  EXPECT_EQ(block_lengths(sides), Eigen::Vector3d(8, 9, 10));
}

TEST(SpaceBlockGoal, TakesTheWorstDirection) {
  const SpaceBlockGoal goal{{0.8, 0.9, 0.9}, {}};
  const SpaceBlockError error = space_block_error(goal, {10, 10, 20}, {8, 9.2, 17});
  EXPECT_TRUE(error.factors.isApprox(Eigen::Vector3d(0.8, 0.92, 0.85)));
  EXPECT_NEAR(error.off, 0.05, 1e-15);
}

}  // namespace
}  // namespace kinetix::targets
