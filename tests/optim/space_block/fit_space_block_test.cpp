#include "optim/space_block/fit_space_block.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "model/closure/mobility.hpp"

namespace kinetix::optim {
namespace {

using ::testing::HasSubstr;

targets::SpaceBlockError error_of(const targets::SpaceBlockGoal& goal, const model::SodaliteStructure& block,
                                  const model::State& state) {
  return space_block_error(goal,
                           targets::block_lengths(block_sides(block, rest_state(model::Linkage(block)))),
                           targets::block_lengths(block_sides(block, state)));
}

// Against the closed form of the lattice, whose gaps know of no classes of edges.
TEST(FitSpaceBlock, ShrinksByAnyFactorsThatNoDirectionLeads) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.1, 0.2);
  for (int k = 0; k < 20; ++k) {
    const targets::SpaceBlockGoal goal{{1 - share(random), 1 - share(random), 1 - share(random)}, {}};
    SpaceBlockVariables variables;
    variables.cells = {2, 1, 1 + k % 2};
    if (!obstacle(goal, variables).empty()) continue;
    const SpaceBlockDesign found = fit_space_block(goal, variables, 0.05);
    const model::SodaliteStructure block = block_of(found, {found.edge_mm, 1.6, 3});
    const model::ExactMotion exact = exact_motion(block);
    ASSERT_TRUE(exact) << exact.why;
    const model::State state = exact.at(found.theta);
    EXPECT_LE(hinge_gaps(block, state).max, 1e-12);
    EXPECT_LE(error_of(goal, block, state).off, 1e-12);
    EXPECT_NEAR(found.gusset.minCoeff(), 0.2, 0.02);
  }
}

TEST(FitSpaceBlock, HasOneFreedom) {
  const SpaceBlockDesign found = fit_space_block({{0.85, 0.9, 0.88}, {}}, {}, 0.05);
  const model::SodaliteStructure block = block_of(found, {found.edge_mm, 1.6, 3});
  EXPECT_EQ(mobility(block, exact_motion(block)).dofs_along, 1);
}

TEST(FitSpaceBlock, TakesTheSizeAskedFor) {
  const SpaceBlockDesign cube = fit_space_block({{0.9, 0.9, 0.9}, Eigen::Vector3d(120, 120, 60)}, {}, 0.01);
  EXPECT_EQ(cube.cells, (std::array<int, 3>{4, 4, 2}));
  EXPECT_LE(cube.size_off, 1e-12);
  EXPECT_TRUE(cube.size_mm.isApprox(Eigen::Vector3d(120, 120, 60)));
  const SpaceBlockDesign odd = fit_space_block({{0.9, 0.9, 0.9}, Eigen::Vector3d(100, 77, 50)}, {}, 0.02);
  EXPECT_LE(odd.size_off, 0.02);
  SpaceBlockVariables own;
  own.edge_mm = 10;
  const SpaceBlockDesign by_edge = fit_space_block({{0.9, 0.9, 0.9}, Eigen::Vector3d(60, 60, 60)}, own, 0.02);
  EXPECT_EQ(by_edge.edge_mm, 10);
  EXPECT_EQ(by_edge.cells, (std::array<int, 3>{2, 2, 2}));
}

/// A cube of 101.96 mm is off by as much either way, over the lengths asked for.
TEST(FitSpaceBlock, TakesTheEdgeOfOwnCellsThatMissesTheSizeLeast) {
  SpaceBlockVariables own;
  own.cells = {2, 2, 2};
  const SpaceBlockDesign found =
      fit_space_block({{0.9, 0.9, 0.9}, Eigen::Vector3d(100, 100, 104)}, own, 0.02);
  EXPECT_NEAR(found.size_off, 4.0 / 204, 1e-12);
  EXPECT_NEAR(found.size_mm[0], 100 * (1 + 4.0 / 204), 1e-9);
}

/// Gussets of a fifth of the edge at one side would be too long at another.
TEST(FitSpaceBlock, TakesShorterGussetsThanUsualWhereLongOnesWouldBeTooLong) {
  const targets::SpaceBlockGoal goal{{0.88, 0.841, 0.781}, {}};
  ASSERT_EQ(obstacle(goal, {}), "");
  const SpaceBlockDesign found = fit_space_block(goal, {}, 0.05);
  EXPECT_GE(found.gusset.minCoeff(), 0.1);
  EXPECT_NEAR(found.gusset.maxCoeff(), 0.8, 1e-12);
  const model::SodaliteStructure block = block_of(found, {found.edge_mm, 0.2, 1});
  const model::ExactMotion exact = exact_motion(block);
  ASSERT_TRUE(exact) << exact.why;
  EXPECT_LE(error_of(goal, block, exact.at(found.theta)).off, 1e-12);
}

TEST(FitSpaceBlock, SaysWhatStandsInTheWay) {
  EXPECT_EQ(obstacle({{0.9, 0.9, 0.9}, {}}, {}), "");
  EXPECT_THAT(obstacle({{0.7, 0.9, 0.9}, {}}, {}),
              HasSubstr("shrinks by 0.3 and the others together by 0.2"));
  EXPECT_THAT(obstacle({{0.4, 0.4, 0.4}, {}}, {}), HasSubstr("has all gussets from 0.1 to 0.8 edges"));
}

}  // namespace
}  // namespace kinetix::optim
