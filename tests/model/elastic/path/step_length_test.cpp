#include "model/elastic/path/step_length.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace kinetix::model
