#include <gtest/gtest.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "model/base/invalid_input.hpp"
#include "model/contact/wall_contact.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

std::vector<std::pair<int, int>> all_pairs_within(const Eigen::Matrix3Xd& points, double distance) {
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < points.cols(); ++a)
    for (int b = a + 1; b < points.cols(); ++b)
      if ((points.col(a) - points.col(b)).squaredNorm() < distance * distance) pairs.push_back({a, b});
  return pairs;
}

TEST(NearPairs, AreThoseOfAllPairs) {
  std::mt19937 random(63);
  std::uniform_real_distribution<double> unit(-1, 1);
  NearPairs near;
  for (const Eigen::Vector3d& extent :
       {Eigen::Vector3d(10, 1, 1), {3, 3, 3}, {0, 5, 0.1}, {2, 0, 20}, {0, 0, 0}})
    for (const int count : {0, 1, 2, 300}) {
      Eigen::Matrix3Xd points(3, count);
      for (int k = 0; k < count; ++k)
        points.col(k) = extent.cwiseProduct(Eigen::Vector3d(unit(random), unit(random), unit(random)));
      auto pairs = near.find(points, 0.7);
      std::sort(pairs.begin(), pairs.end());
      EXPECT_EQ(pairs, all_pairs_within(points, 0.7)) << "seed 63, extent " << extent.transpose();
    }
}

TEST(NearPairs, OfALatticeAreItsNeighbours) {
  Eigen::Matrix3Xd points(3, 100);
  for (int k = 0; k < 100; ++k) points.col(k) = Eigen::Vector3d(k % 10, k / 10, 0);
  EXPECT_EQ(NearPairs().find(points, 1.1).size(), 180u);
  EXPECT_EQ(NearPairs().find(points, 1.0).size(), 0u);
}

using testing::random_design;
using testing::structure_of;

ContactRange range_of(const Structure& s, const ThetaRangeOptions& options = {}) {
  return theta_range(s, exact_motion(s), options);
}

Vertex vertex_of(const Structure& s, int wall) { return s.bodies[half_walls(s)[wall].body]; }

/// Every pair of plates of different bodies and walls, without a broad phase or a memory of the flat state.
bool any_overlap(const Structure& s, const State& state) {
  const auto walls = half_walls(s);
  for (std::size_t a = 0; a < walls.size(); ++a)
    for (std::size_t b = a + 1; b < walls.size(); ++b) {
      if (walls[a].body == walls[b].body || walls[a].hinge == walls[b].hinge) continue;
      if (overlap(placed(walls[a], state[walls[a].body]), placed(walls[b], state[walls[b].body]), 1e-9))
        return true;
    }
  return false;
}

Structure rolling_strip(int columns, double beta) {
  auto design = ExactDesign<double>::basic(columns, 1);
  for (int c = 0; c < columns; c += 2) design.beta[c] = beta;
  return structure_of(design);
}

TEST(HalfWalls, ReachFromTheVertexToTheHinge) {
  std::mt19937 random(71);
  const Structure s = structure_of(random_design(Family::F2, 4, 3, random));
  const auto walls = half_walls(s);
  ASSERT_EQ(walls.size(), 2 * s.hinges.size());
  const State rest = rest_state(s);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const Hinge& hinge = s.hinges[k / 2];
    EXPECT_EQ(walls[k].body, k % 2 == 0 ? hinge.lower : hinge.upper);
    const OrientedBox plate = placed(walls[k], rest[walls[k].body]);
    const Eigen::Vector3d end = plate.center + plate.half[0] * plate.axes.col(0);
    const Eigen::Vector3d start = plate.center - plate.half[0] * plate.axes.col(0);
    EXPECT_LE((end - s.hinge_point(hinge)).norm(), 1e-13) << "seed 71";
    EXPECT_LE((start - s.rest_position(walls[k].body)).norm(), 1e-13) << "seed 71";
    EXPECT_LE((plate.axes.col(1) - wall_up(hinge.wall.axis, hinge.parameters.beta)).norm(), 1e-15);
    EXPECT_NEAR(plate.axes.determinant(), 1, 1e-14);
  }
}

TEST(ThetaRange, BasicCellsEndWhereOppositeWallTipsMeet) {
  for (const double thickness : {0.1, 0.8, 2.0, 4.0})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {1, 3}, {3, 3}}) {
      const Structure s = make_structure(rectangle(columns, rows), {10, thickness, 6});
      const ContactRange range = range_of(s);
      const double expected = std::atan(1 - thickness / 10);
      EXPECT_NEAR(range.positive.theta, expected, 1e-7);
      EXPECT_NEAR(range.negative.theta, -expected, 1e-7);
      EXPECT_TRUE(range.positive.touches && range.negative.touches);
      EXPECT_TRUE(range.touching_at_rest.empty());
    }
}

TEST(ThetaRange, NamesTheWallTipsThatMeet) {
  const Structure s = make_structure({{0, 0}}, {});
  const ContactRange range = range_of(s);
  const auto walls = half_walls(s);
  const auto axis = [&](int wall) { return s.hinges[walls[wall].hinge].wall.axis; };
  EXPECT_EQ(axis(range.positive.walls.first), Axis::x);
  EXPECT_EQ(axis(range.positive.walls.second), Axis::x);
  EXPECT_EQ(axis(range.negative.walls.first), Axis::y);
  EXPECT_EQ(axis(range.negative.walls.second), Axis::y);
  EXPECT_NE(walls[range.positive.walls.first].hinge, walls[range.positive.walls.second].hinge);
}

TEST(ThetaRange, CrossableUnitFoldsPastTheLineOfItsBars) {
  auto design = ExactDesign<double>::basic(3, 3);
  design.t.assign(3, 0.3);
  design.s.assign(3, 0.3);
  EXPECT_GT(range_of(structure_of(design)).positive.theta, 60 * radians_per_degree);
  design.s.assign(3, 0.7);
  EXPECT_LT(range_of(structure_of(design)).positive.theta, 45 * radians_per_degree);
}

TEST(ThetaRange, IsFreeBelowItsEndsAndBlockedBeyondByAllPairs) {
  std::mt19937 random(72);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {4, 2}, {12, 1}}) {
      const Structure s = structure_of(random_design(family, columns, rows, random));
      const Classification exact = classify(s);
      const ContactRange range = theta_range(s, exact_motion(s, exact));
      for (const ContactLimit& end : {range.negative, range.positive}) {
        ASSERT_TRUE(end.touches);
        EXPECT_TRUE(any_overlap(s, fold(exact, s, end.theta * (1 + 1e-6))))
            << to_string(family) << " seed 72";
        for (int k = 0; k <= 40; ++k)
          EXPECT_FALSE(any_overlap(s, fold(exact, s, (1 - 1e-6) * end.theta * k / 40)))
              << to_string(family) << " seed 72";
      }
    }
}

TEST(ThetaRange, MirroredTiltsMirrorTheRange) {
  std::mt19937 random(73);
  const auto design = random_design(Family::F2, 6, 1, random);
  auto mirrored = design;
  for (double& beta : mirrored.beta) beta = -beta;
  const ContactRange a = range_of(structure_of(design)), b = range_of(structure_of(mirrored));
  EXPECT_NEAR(a.positive.theta, b.positive.theta, 1e-7) << "seed 73";
  EXPECT_NEAR(a.negative.theta, b.negative.theta, 1e-7) << "seed 73";
}

/// Every other column folds by 2 psi, tan(psi) = tan(beta) sin(theta): n of them make a full turn at psi =
/// pi/n.
TEST(ThetaRange, RollingStripEndsJustBeforeItClosesItsRing) {
  const double beta = 40 * radians_per_degree;
  for (const int columns : {40, 60}) {
    const double full_turn = std::asin(std::tan(pi / (columns / 2)) / std::tan(beta));
    const Structure s = rolling_strip(columns, beta);
    const ContactRange range = range_of(s);
    EXPECT_LT(range.positive.theta, full_turn);
    EXPECT_GT(range.positive.theta, 0.97 * full_turn);
    const int first = vertex_of(s, range.positive.walls.first).i,
              second = vertex_of(s, range.positive.walls.second).i;
    EXPECT_GE(std::abs(first - second), columns - 2);
  }
}

TEST(ThetaRange, ShortStripDoesNotMeetItself) {
  const Structure s = rolling_strip(8, 40 * radians_per_degree);
  const ContactRange range = range_of(s);
  EXPECT_LE(
      std::abs(vertex_of(s, range.positive.walls.first).i - vertex_of(s, range.positive.walls.second).i), 2);
}

TEST(ThetaRange, SpiralMeetsAnEarlierTurnOfItself) {
  auto design = ExactDesign<double>::basic(60, 1);
  for (int c = 0; c < 60; c += 2) design.beta[c] = (15 + 0.5 * c) * radians_per_degree;
  const Structure s = structure_of(design);
  const ContactRange range = range_of(s);
  ASSERT_TRUE(range.positive.touches && range.negative.touches);
  EXPECT_GT(
      std::abs(vertex_of(s, range.negative.walls.first).i - vertex_of(s, range.negative.walls.second).i), 10);
  EXPECT_TRUE(any_overlap(s, fold(classify(s), s, range.negative.theta - 1e-6)));
  EXPECT_FALSE(any_overlap(s, fold(classify(s), s, range.negative.theta + 1e-6)));
}

TEST(WallContact, LeavesOutPlatesThatTouchWhenBuilt) {
  Structure s = make_structure(rectangle(2, 1), {});
  for (Hinge& h : s.hinges) h.parameters.t = h.wall.from.is_in_sublattice_a() ? 0.97 : 0.03;
  WallContact contact(s);
  EXPECT_FALSE(contact.touching_at_rest().empty());
  EXPECT_TRUE(contact.overlapping(rest_state(s)).empty());
  EXPECT_EQ(range_of(s).touching_at_rest, contact.touching_at_rest());
}

TEST(WallContact, BasicSheetTouchesNowhereAtRest) {
  const Structure s = make_structure(rectangle(6, 5), {});
  EXPECT_TRUE(WallContact(s).touching_at_rest().empty());
}

TEST(ThetaRange, StopsAtTheLimitOfTheSearch) {
  const ContactRange range = range_of(make_structure({{0, 0}}, {}), {.limit = 0.3});
  EXPECT_EQ(range.positive.theta, 0.3);
  EXPECT_EQ(range.negative.theta, -0.3);
  EXPECT_FALSE(range.positive.touches);
}

TEST(ThetaRange, StopsWhereTheMotionIsNotFinite) {
  const Structure s = make_structure({{0, 0}}, {});
  const Classification exact = classify(s);
  ExactMotion broken = exact_motion(s, exact);
  broken.at = [&](double theta) {
    return fold(exact, s, theta > 0.2 ? std::numeric_limits<double>::quiet_NaN() : theta);
  };
  const ContactRange range = theta_range(s, broken);
  EXPECT_FALSE(range.positive.touches);
  EXPECT_LE(range.positive.theta, 0.2);
  EXPECT_TRUE(range.negative.touches);
}

TEST(ThetaRange, DoesNotDependOnTheStep) {
  std::mt19937 random(74);
  const Structure s = structure_of(random_design(Family::F2, 8, 2, random));
  const ContactRange coarse = range_of(s, {.step = 2 * radians_per_degree}),
                     fine = range_of(s, {.step = 0.1 * radians_per_degree});
  EXPECT_NEAR(coarse.positive.theta, fine.positive.theta, 1e-8) << "seed 74";
  EXPECT_NEAR(coarse.negative.theta, fine.negative.theta, 1e-8) << "seed 74";
}

TEST(ThetaRange, ReachesItsFinestPrecision) {
  const ContactRange range = range_of(make_structure({{0, 0}}, {}), {.precision = 1e-14});
  EXPECT_NEAR(range.positive.theta, std::atan(1 - 0.08), 1e-9);
}

TEST(ThetaRange, RefusesOptionsAndStructuresOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Structure s = make_structure({{0, 0}}, {});
  for (const double limit : {0.0, 1.6, nan}) EXPECT_THROW(range_of(s, {.limit = limit}), InvalidInput);
  for (const double step : {nan, 0.0, 1e-20}) EXPECT_THROW(range_of(s, {.step = step}), InvalidInput);
  for (const double precision : {nan, 0.0, 1e-20})
    EXPECT_THROW(range_of(s, {.precision = precision}), InvalidInput) << "would bisect for ever";
  s.hinges[0].parameters.alpha = 1;
  EXPECT_THROW(range_of(s), InvalidInput);
}

}  // namespace
}  // namespace kinetix::model
