#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "model/contact/wall_contact.hpp"
#include "model/elastic/path/step_solver.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::model {
namespace {

const EquilibriumPathOptions usual;  // first step 0.02, longest 0.12, touching 0.02, least 1e-3, jump 0.1 rad

TEST(StepLength, BeginsWithTheFirstStepTowardsTheGoal) {
  EXPECT_EQ(StepLength(usual, 0.5).next(0).theta, 0.02);
  EXPECT_EQ(StepLength(usual, -0.5).next(0).theta, -0.02);
  EXPECT_EQ(StepLength(usual, 0.01).next(0).theta, 0.01);
}

TEST(StepLength, EndsOnTheGoalExactly) {
  const StepLength length(usual, 0.05);
  EXPECT_FALSE(length.next(0.02).to_goal);
  for (const double from : {0.03, 0.03 - 1e-12, 0.04}) {
    const NextStep last = length.next(from);
    EXPECT_TRUE(last.to_goal) << from;
    EXPECT_EQ(last.theta, 0.05) << from;
    EXPECT_EQ(last.length, 0.05 - from) << from;
  }
}

TEST(StepLength, GrowsAsTheErrorOfThePredictionAllows) {
  const StepLength length(usual, 1);
  EXPECT_NEAR(length.growth(0.04, 1), 1, 1e-12);
  EXPECT_NEAR(length.growth(0.02, 1), std::sqrt(2), 1e-12);
  EXPECT_NEAR(length.growth(0.02, 2), std::cbrt(2), 1e-12);
  EXPECT_NEAR(length.growth(0.16, 1), 0.5, 1e-12);
  EXPECT_EQ(length.growth(0, 1), 2);
  EXPECT_EQ(length.growth(10, 1), 0.25);
  EXPECT_EQ(length.growth(NAN, 1), 0.25);
}

TEST(StepLength, IsAtMostTheLongestAndShorterWhereWallsTouch) {
  StepLength length(usual, 1.5);
  length.change(100, false);
  EXPECT_EQ(length.next(0).length, 0.12);
  EXPECT_FALSE(length.next(0).is_short);
  length.change(100, true);
  EXPECT_EQ(length.next(0).length, 0.02);
  EXPECT_TRUE(length.next(0).is_short);
}

TEST(StepLength, IsHalvedAtLeastUntilItIsTheShortest) {
  StepLength length(usual, 1);
  length.shorten(length.next(0), 0.9);
  EXPECT_EQ(length.next(0).length, 0.01);
  length.shorten(length.next(0), 0.25);
  EXPECT_EQ(length.next(0).length, 0.0025);
  EXPECT_FALSE(length.next(0).is_shortest);
  for (int k = 0; k < 2; ++k) length.shorten(length.next(0), 0.5);
  EXPECT_EQ(length.next(0).length, 1e-3);
  EXPECT_TRUE(length.next(0).is_shortest);
}

TEST(StepLength, OfALastStepThatWasRefusedIsHalfOfWhatWasLeft) {
  StepLength length(usual, 1);
  const NextStep last = length.next(0.99);
  EXPECT_TRUE(last.to_goal);
  length.shorten(last, 0.5);
  EXPECT_NEAR(length.next(0.99).length, 0.005, 1e-15);
}

TEST(StepLength, BeforeTheGoalDoesNotDependOnIt) {
  for (const double goal : {0.001, 0.01, 0.3, 1.5}) {
    EXPECT_EQ(StepLength(usual, goal).next_beyond(0).theta, 0.02) << goal;
    StepLength length(usual, goal);
    length.change(2, false);
    EXPECT_EQ(length.next_beyond(0).theta, 0.04) << goal;
  }
}

TEST(StepLength, LandsOnTheGoalAtTheFurthest) {
  const StepLength length(usual, -0.5);
  EXPECT_NEAR(length.landing(-0.1, 0.02).theta, -0.12, 1e-15);
  EXPECT_EQ(length.landing(-0.49, 0.02).theta, -0.5);
  EXPECT_TRUE(length.landing(-0.49, 0.02).to_goal);
  EXPECT_TRUE(length.landing(-0.1, 0.02).is_short);
}

/// Two of its walls are tip to tip during the motion, and a snap would take one across the other.
TEST(EquilibriumPath, NeverHasWallsThatCrossEachOther) {
  CellSize size;
  size.thickness_mm = 0.4;
  const PlanarStructure panel = make_planar_structure({&octagon_lattice, lattice_cells(3, 3), 0, true}, size);
  const DrivenLinkage driven{panel, plate_drive(panel, Axis::y, 0.1339746, 1), exact_motion(panel)};
  ContactModel walls(panel, true);
  const State flat = rest_state(panel);
  int steps = 0;
  trace_equilibrium(driven, {.k_turn = 10}, {}, [&](const EquilibriumStep& step, const State& state) {
    EXPECT_FALSE(walls.newly_cross(flat, state)) << "theta " << step.theta;
    ++steps;
  });
  EXPECT_GE(steps, 10);
}

/// Pairs of half walls that are in each other by half a thickness or more, apart from those that touch in the flat state.
std::vector<WallPair> deep_in_each_other(const Linkage& sheet, const std::vector<WallPair>& at_rest,
                                         const State& state) {
  const std::vector<HalfWall> walls = half_walls(sheet);
  std::vector<WallPair> found = WallContact(sheet).overlapping(state);
  std::erase_if(found, [&](const WallPair& pair) {
    const HalfWall &a = walls[pair.first], &b = walls[pair.second];
    return std::find(at_rest.begin(), at_rest.end(), pair) != at_rest.end() ||
           !overlap(placed(a, state[a.body]), placed(b, state[b.body]), sheet.size.thickness_mm / 2);
  });
  return found;
}

/// The walls of each column lean towards each other. Their upper edges meet before a tendon has pulled the strip's ends
/// together. Walls of the random panels meet in any way.
void expect_walls_never_deep(int panels) {
  const double tilt = 40 * radians_per_degree;
  std::vector<DrivenLinkage> sheets;
  const Structure strip = testing::alternating(8, 1, {.beta = tilt}, {.beta = -tilt});
  const std::vector<int> through = {*strip.hinge_at({{0, 0}, Axis::x}), *strip.hinge_at({{7, 1}, Axis::x})};
  sheets.push_back({strip, cord_drive(strip, through, 60, 1), exact_motion(strip)});
  std::mt19937 random(3);
  for (int k = 0; k < panels; ++k) {
    Structure panel = testing::random_panel(4, 1 + k % 2, random);
    sheets.push_back({panel, drive_on(panel, drive_to(panel, 0.7)), exact_motion(panel)});
  }
  int in_contact = 0;
  for (const DrivenLinkage& driven : sheets) {
    const auto at_rest = WallContact(driven.linkage).touching_at_rest();
    trace_equilibrium(driven, {.k_point = 1000, .k_turn = 0.1, .k_contact = 5000}, {},
                      [&](const EquilibriumStep& step, const State& state) {
                        EXPECT_TRUE(deep_in_each_other(driven.linkage, at_rest, state).empty())
                            << "theta " << step.theta;
                        in_contact += step.contacts > 0;
                      });
  }
  EXPECT_GE(in_contact, 20);
}

TEST(EquilibriumPath, OfASheetInSpaceNeverHasWallsDeepInEachOther) { expect_walls_never_deep(3); }

TEST(EquilibriumPathSoak, OfASheetInSpaceNeverHasWallsDeepInEachOther) { expect_walls_never_deep(8); }

}  // namespace
}  // namespace kinetix::model
