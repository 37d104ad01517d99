#include "optim/space_curve/space_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/base/invalid_input.hpp"
#include "optim/space_curve/fit_space_curve.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

targets::SpaceGoal helix(double turns, double radius, double pitch,
                         const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
  std::vector<Vector3d> points;
  for (int k = 0; k <= 480; ++k) {
    const double a = 2 * std::numbers::pi * turns * k / 480;
    points.push_back(
        turn * Vector3d(radius * std::cos(a), radius * std::sin(a), pitch * a / (2 * std::numbers::pi)));
  }
  return targets::SpaceGoal(points);
}

SpaceVariables with_columns(int columns) {
  SpaceVariables v;
  v.columns = columns;
  return v;
}

// The strip climbs in steps, so that the error falls with the first power of the columns.
TEST(SpaceFit, AHelixOfTwoTurnsIsFollowed) {
  for (const int columns : {48, 96}) {
    const SpaceDesign found = fit_space_curve(helix(2, 40, 40), with_columns(columns), {});
    EXPECT_LE(found.error.rms, 2.4e-3 * 96 / columns);
    EXPECT_TRUE(found.error.settled);
    EXPECT_FALSE(found.contact.touches);
    EXPECT_NEAR(std::abs(found.across.direction.z()), 1, 1e-6);
  }
}

TEST(SpaceFit, AHelixThatLiesAnyWayInSpaceIsFollowedAsWell) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const SpaceDesign found = fit_space_curve(helix(2, 40, 40, turn), with_columns(48), {});
  EXPECT_LE(found.error.rms, 2.4e-3 * 96 / 48);
  EXPECT_FALSE(found.contact.touches);
}

TEST(SpaceFit, WallsThatAreGivenStayWhileCellsAreSought) {
  SpaceVariables v = with_columns(48);
  v.size = {.edge_mm = 12, .thickness_mm = 0.8, .height_mm = 5};
  v.free_walls = false;
  const SpaceDesign given = fit_space_curve(helix(1, 40, 30), v, {});
  EXPECT_NE(given.size.edge_mm, 12);
  EXPECT_EQ(given.size.thickness_mm, 0.8);
  EXPECT_EQ(given.size.height_mm, 5);
  v.free_walls = true;
  const SpaceDesign free = fit_space_curve(helix(1, 40, 30), v, {});
  EXPECT_NEAR(free.size.thickness_mm, 0.8 / 12 * free.size.edge_mm, 1e-12);
  EXPECT_NEAR(free.size.height_mm, 5.0 / 12 * free.size.edge_mm, 1e-12);
}

// Its chords and heights are those that the lattice folds to.
TEST(SpaceFit, AStripAsItIsDescribedIsTheStripThatFolds) {
  const SpaceDesign found = fit_space_curve(helix(1, 40, 30), with_columns(31), {});
  const std::vector<Vector3d> described = found.strip.midline(),
                              folded = space_midline(fold(found.design, sheet_of(found.design, found.size)));
  ASSERT_EQ(described.size(), folded.size());
  for (std::size_t a = 0; a < folded.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_NEAR((described[a] - described[b]).norm(), (folded[a] - folded[b]).norm(), 1e-10);
  EXPECT_NEAR(
      (described[20] - described[0]).cross(described[10] - described[0]).dot(described[30] - described[0]),
      (folded[20] - folded[0]).cross(folded[10] - folded[0]).dot(folded[30] - folded[0]), 1e-6);
}

TEST(SpaceFit, DerivativesAreThoseOfTheResiduals) {
  const targets::SpaceGoal goal = helix(1, 40, 20);
  SpaceStrip strip = followed(goal.line(), 12);
  const SpaceFit fit(goal.line(), goal.diagonal(), strip, {});
  Eigen::VectorXd x = fit.pack(strip);
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] += 0.013 * std::sin(7.0 * static_cast<double>(k));
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  ASSERT_TRUE(fit.evaluate(x, r, &J));
  const auto residuals = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd out;
    EXPECT_TRUE(fit.evaluate(at, out, nullptr));
    return out;
  };
  EXPECT_LE(testing::relative_difference(J, testing::numeric_jacobian(residuals, x, 1e-6)), 1e-6);
}

TEST(SpaceFit, WhatClimbsOrTurnsTooMuchIsNamedWithItsPlace) {
  const auto steep = obstacle(helix(2, 40, 300), with_columns(96));
  ASSERT_TRUE(steep);
  EXPECT_NE(steep->why.find("climbs"), std::string::npos);
  SpaceVariables gentle = with_columns(40);
  gentle.beta = 20 * radians_per_degree;
  const auto sharp = obstacle(targets::SpaceGoal({{0, 0, 0}, {50, 0, 0}, {50, 1, 50}, {100, 1, 50}}), gentle);
  ASSERT_TRUE(sharp);
  EXPECT_NE(sharp->why.find("turns"), std::string::npos);
  EXPECT_LT(std::min(std::abs(sharp->arc_mm - 50), std::abs(sharp->arc_mm - 100)), 6);
  EXPECT_FALSE(obstacle(helix(2, 40, 40), with_columns(96)));
}

targets::SpaceGoal wave(double height, int waves) {
  std::vector<Vector3d> points;
  for (int k = 0; k <= 400; ++k) {
    const double u = 0.97 * 2 * std::numbers::pi * k / 400;
    points.emplace_back(80 * std::cos(u), 80 * std::sin(u), height * std::sin(waves * u));
  }
  return targets::SpaceGoal(points);
}

/// A flat ring would miss the wave by its height over the square root of two.
TEST(SpaceFit, AGoalOutOfReachGetsTheNearestStrip) {
  const targets::SpaceGoal goal = wave(14, 9);
  const SpaceVariables v = with_columns(48);
  const SpaceDesign found = fit_space_curve(goal, v, {});
  ASSERT_TRUE(found.obstacle);
  EXPECT_NE(found.obstacle->why.find("climbs"), std::string::npos) << found.obstacle->why;
  EXPECT_LT(found.error.rms * goal.diagonal(), 0.8 * 14 / std::numbers::sqrt2);
  EXPECT_FALSE(found.contact.touches);
  for (const double t : found.design.t) {
    EXPECT_GE(t, v.t[0] - 1e-9);
    EXPECT_LE(t, v.t[1] + 1e-9);
  }
  for (const double beta : found.design.beta) EXPECT_LE(std::abs(beta), v.beta + 1e-9);
}

}  // namespace
}  // namespace kinetix::optim
