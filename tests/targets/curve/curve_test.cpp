#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "targets/curve/curve.hpp"
#include "targets/curve/polyline.hpp"
#include "tests/support/curves.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> moved(std::vector<Vector2d> points, double turn, const Vector2d& shift) {
  for (Vector2d& p : points) p = Eigen::Rotation2Dd(turn) * p + shift;
  return points;
}

TEST(CurveError, VanishesForARigidlyMovedCopy) {
  const Curve goal = testing::s_curve(60);
  const CurveError error = curve_error(moved(goal.points(), 2.1, {300, -70}), goal);
  EXPECT_TRUE(error.settled);
  EXPECT_LE(error.rms, 1e-13);
  EXPECT_LE(error.max, 1e-12);
}

TEST(CurveError, DoesNotDependOnWhereTheMidlineLies) {
  const Curve goal = testing::half_circle(100, 200);
  const std::vector<Vector2d> midline = testing::half_circle(101, 13).points();
  const double here = curve_error(midline, goal).rms;
  const double there = curve_error(moved(midline, -1.3, {5, 900}), goal).rms;
  EXPECT_NEAR(here, there, 1e-9 * here);
}

TEST(CurveError, OfACircleInscribedByAPolygonIsThatOfItsSagitta) {
  // Each side lies under its arc by a parabola of sagitta h: mean 2h/3, variance 4/45 h^2. Of the mean a
  // shift along z removes the share (mean of sin)^2 / mean of sin^2 = 8/pi^2.
  const int sides = 40;
  const double radius = 100, sagitta = radius * (1 - std::cos(pi / (2 * sides)));
  const Curve goal = testing::half_circle(radius, 40 * sides + 1);
  const CurveError error = curve_error(testing::half_circle(radius, sides + 1).points(), goal);
  const double expected = sagitta * std::sqrt(4.0 / 45 + 4.0 / 9 * (1 - 8 / (pi * pi)));
  EXPECT_NEAR(error.rms * error.scale_mm, expected, 0.01 * expected);
}

TEST(CurveError, OfAStripTooShortIsTheUncoveredEnd) {
  // Straight strip of length 80 on a straight goal of 100: 10 stick out at each end, distance 0..10.
  const Curve goal({{0, 0}, {50, 0}, {100, 0}});
  std::vector<Vector2d> strip;
  for (int k = 0; k <= 80; ++k) strip.emplace_back(k, 0);
  const CurveError error = curve_error(strip, goal);
  EXPECT_NEAR(error.max, 0.1, 1e-9);
  const double goal_mean_square = 2 * (1000.0 / 3) / 100;
  EXPECT_NEAR(error.rms * 100, std::sqrt(goal_mean_square / 2), 0.01);
}

TEST(CurveError, KeepsHandedness) {
  const Curve goal({{0, 0}, {50, 0}, {80, 10}, {80, 60}});
  std::vector<Vector2d> mirrored = goal.points();
  for (Vector2d& p : mirrored) p.y() = -p.y();
  EXPECT_GT(curve_error(mirrored, goal).rms, 0.02);
}

TEST(CurveError, OfNaNIsNaN) {
  const CurveError error = curve_error({{0, 0}, {std::nan(""), 1}}, testing::half_circle());
  EXPECT_TRUE(std::isnan(error.rms));
  EXPECT_TRUE(std::isnan(error.max));
  EXPECT_FALSE(error.settled);
}

TEST(Curve, IsFiniteUpToItsEnds) {
  const Curve curve = testing::s_curve(60);
  for (const double s : {-1.0, 0.0, 0.3 * curve.length(), curve.length(), curve.length() + 1})
    EXPECT_TRUE(curve.at(s).allFinite()) << s;
  EXPECT_EQ(curve.at(0), curve.points().front());
  EXPECT_LE((curve.at(curve.length()) - curve.points().back()).norm(), 1e-12);
}

TEST(Curve, RefusesAPointSoNearThatTheLengthDoesNotGrow) {
  try {
    Curve({{0, 0}, {1e5, 0}, {1e5, 1e-12}});
    ADD_FAILURE() << "accepted";
  } catch (const InvalidCurve& error) {
    EXPECT_EQ(error.point(), 2);
    EXPECT_EQ(error.reason(), "points 2 and 3 are the same. Remove one of them");
  }
}

TEST(PolylineTree, FindsTheSameFootAsTryingEverySegment) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Vector2d> points;
  for (int k = 0; k < 300; ++k) points.emplace_back(unit(random), unit(random));
  const PolylineTree tree(points);
  for (int n = 0; n < 500; ++n) {
    const Vector2d p(1.5 * unit(random), 1.5 * unit(random));
    double least = INFINITY;
    for (int k = 0; k + 1 < 300; ++k)
      least = std::min(least, std::abs(closest_on_segment(points, k, p).distance));
    EXPECT_NEAR(std::abs(tree.nearest(p).distance), least, 1e-14);
  }
}

TEST(ClosestPoint, KnowsItsSideAndTheGradientOfTheDistance) {
  const std::vector<Vector2d> corner = {{0, 0}, {10, 0}, {10, 10}};
  EXPECT_DOUBLE_EQ(closest_near(corner, 0, {5, 2}).distance, 2);
  EXPECT_DOUBLE_EQ(closest_near(corner, 0, {5, -2}).distance, -2);
  const ClosestPoint outside = closest_near(corner, 0, {13, -4});
  EXPECT_DOUBLE_EQ(outside.distance, -5);
  EXPECT_NEAR((outside.normal - Vector2d(-0.6, 0.8)).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace kinetix::targets
