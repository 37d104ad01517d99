#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "model/base/geometry.hpp"
#include "targets/curve/curve.hpp"
#include "targets/outline/outline.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;
using testing::refusal;
using Points = std::vector<Vector2d>;

Points square(double side, const Vector2d& from = {0, 0}) {
  return {from, from + Vector2d(side, 0), from + Vector2d(side, side), from + Vector2d(0, side)};
}

/// An L of 3 squares, with a corner that points inwards.
const Points ell = {{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}};

/// Returns an outline around a point, at a changing distance.
Points star(int corners, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(4, 12);
  Points points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * k / corners;
    points.push_back(Vector2d(3, -2) + radius(random) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

TEST(Outline, KnowsItsAreaMiddleAndPerimeter) {
  const Outline outline(ell);
  EXPECT_NEAR(outline.area(), 300, 1e-12);
  EXPECT_NEAR(outline.perimeter(), 80, 1e-12);
  EXPECT_NEAR(outline.diagonal(), std::hypot(20, 20), 1e-12);
  EXPECT_LE((outline.middle() - Vector2d(25.0 / 3, 25.0 / 3)).norm(), 1e-12) << "of three squares";
  const Outline far(square(2, {1e5, -1e5}));
  EXPECT_NEAR(far.area(), 4, 1e-9);
  EXPECT_LE((far.middle() - Vector2d(1e5 + 1, -1e5 + 1)).norm(), 1e-9);
}

TEST(Outline, RunsCounterClockwiseHoweverItIsGiven) {
  const Points clockwise(ell.rbegin(), ell.rend());
  EXPECT_EQ(Outline(clockwise).points(), ell);
  EXPECT_NEAR(Outline(clockwise).area(), 300, 1e-12);
  EXPECT_LE((Outline(clockwise).middle() - Outline(ell).middle()).norm(), 1e-12);
}

// Lengths along an outline that is given clockwise were those of the next side.
TEST(Outline, HasTheSamePointsByArcLengthHoweverItIsGiven) {
  const Points clockwise(ell.rbegin(), ell.rend());
  const Outline outline(ell), other(clockwise);
  for (double s = -3; s < 90; s += 1.5) {
    EXPECT_LE((other.at(s) - outline.at(s)).norm(), 1e-12) << s;
    EXPECT_NEAR(other.nearest(outline.at(s) + Vector2d(0.1, 0.2)).arc,
                outline.nearest(outline.at(s) + Vector2d(0.1, 0.2)).arc, 1e-12)
        << s;
  }
}

TEST(Outline, TakesAListThatEndsWhereItBegins) {
  Points closed = ell;
  closed.push_back(ell[0]);
  EXPECT_EQ(Outline(closed).points(), ell);
}

TEST(Outline, HasPointsByArcLengthRoundAndRound) {
  const Outline outline(square(10));
  const std::pair<double, Vector2d> at[] = {{0, {0, 0}},  {5, {5, 0}},  {10, {10, 0}}, {25, {5, 10}},
                                            {38, {0, 2}}, {40, {0, 0}}, {43, {3, 0}},  {-2, {0, 2}}};
  for (const auto& [s, expected] : at) EXPECT_LE((outline.at(s) - expected).norm(), 1e-12) << s;
}

// Along an outline of some 100 mm: a hundredth of a mm from one to the next.
constexpr int samples = 20'000;

/// Returns the distance of p from the nearest of many points along the outline.
double sampled_distance(const Outline& outline, const Vector2d& p) {
  double least = INFINITY;
  for (int k = 0; k < samples; ++k)
    least = std::min(least, (outline.at(outline.perimeter() * k / samples) - p).norm());
  return least;
}

TEST(Outline, FindsTheNearestPointThatSamplesFind) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(-20, 20);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Outline outline(star(9, seed));
    for (int k = 0; k < 30; ++k) {
      const Vector2d p(place(random), place(random));
      const auto [point, normal, arc, distance] = outline.nearest(p);
      const double sampled = sampled_distance(outline, p);
      EXPECT_LE(distance, sampled + 1e-12) << "seed " << seed;
      EXPECT_GE(distance, sampled - outline.perimeter() / samples) << "seed " << seed;
      EXPECT_NEAR((p - point).norm(), distance, 1e-12);
      EXPECT_LE((outline.at(arc) - point).norm(), 1e-9);
      EXPECT_NEAR(normal.norm(), 1, 1e-12);
      const double side = outline.contains(p) ? -1 : 1;
      EXPECT_NEAR(side * distance, normal.dot(p - point), 1e-9)
          << "the normal points outwards, along p's way";
    }
  }
}

TEST(Outline, HasTheNormalOfASideOnItself) {
  const Outline::Nearest on = Outline(square(10)).nearest({4, 0});
  EXPECT_EQ(on.distance, 0);
  EXPECT_EQ(on.normal, Vector2d(0, -1));
  const Outline::Nearest corner = Outline(square(10)).nearest({13, 14});
  EXPECT_LE((corner.normal - Vector2d(0.6, 0.8)).norm(), 1e-12);
  EXPECT_NEAR(corner.distance, 5, 1e-12);
}

// Inside is where the outline winds once round.
TEST(Outline, ContainsWhatItWindsRound) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> place(-12, 16);
  const Outline outline(star(11, 4));
  int inside = 0;
  for (int k = 0; k < 500; ++k) {
    const Vector2d p(place(random), place(random));
    double turns = 0;
    for (std::size_t i = 0; i < outline.points().size(); ++i) {
      const Vector2d a = outline.points()[i] - p, b = outline.points()[(i + 1) % outline.points().size()] - p;
      turns += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) / (2 * pi);
    }
    EXPECT_EQ(outline.contains(p), turns > 0.5) << p.transpose();
    inside += outline.contains(p);
  }
  EXPECT_GT(inside, 50);
}

TEST(Outline, IsRefusedNamingThePointAtFault) {
  const auto refused = [](Points points) { return refusal([&] { Outline outline(std::move(points)); }); };
  EXPECT_THAT(refused({{0, 0}, {1, 0}}), HasSubstr("at least 3 points, this one has 2"));
  EXPECT_THAT(refused({{0, 0}, {1, 0}, {0, 0}}), HasSubstr("at least 3 points, this one has 2"));
  EXPECT_THAT(refused({}), HasSubstr("at least 3 points, this one has 0"));
  EXPECT_THAT(refused({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), HasSubstr("points 2 and 3 are the same"));
  EXPECT_THAT(refused({{0, 0}, {1, 0}, {NAN, 1}}), HasSubstr("point 3 is not a finite number"));
  EXPECT_THAT(refused({{0, 0}, {4, 0}, {2, 0}, {2, 3}}), HasSubstr("turns back on itself at point 2"));
  EXPECT_THAT(refused({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), HasSubstr("segment 1-2 meets segment 3-4"));
  EXPECT_THAT(refused({{0, 0}, {4, 0}, {0, 4}, {4, 4}}), HasSubstr("segment 2-3 meets segment 4-1"))
      << "the last side leads back to the first point";
  EXPECT_THAT(refused({{0, 0}, {4, 0}, {8, 0}}), HasSubstr("turns back on itself"));
}

TEST(OutlineError, OfAShiftedSquareIsThatOfTwoSquaresThatOverlap) {
  const Outline goal(square(10));
  const OutlineError same = outline_error(goal, square(10));
  EXPECT_EQ(same.rms, 0);
  EXPECT_EQ(same.max, 0);
  EXPECT_NEAR(same.iou, 1, 1e-12);
  // Shifted by 4 along x: of the four corners two are on the goal's sides, two stand 4 off.
  const OutlineError shifted = outline_error(goal, square(10, {4, 0}));
  EXPECT_NEAR(shifted.iou, 60.0 / 140, 1e-12);
  EXPECT_NEAR(shifted.max, 4 / goal.diagonal(), 1e-12);
  EXPECT_NEAR(shifted.rms, std::sqrt(2 * 16 / 4.0) / goal.diagonal(), 1e-12);
  EXPECT_NEAR(outline_error(goal, square(10, {20, 0})).iou, 0, 1e-12);
  EXPECT_NEAR(outline_error(goal, square(5, {2, 2})).iou, 0.25, 1e-12);
}

TEST(OutlineError, DoesNotDependOnSizeAndSense) {
  Points corners = star(7, 5), reversed(corners.rbegin(), corners.rend());
  const Points large = star(9, 6);
  Points scaled_goal = large, scaled = corners;
  for (Points* points : {&scaled_goal, &scaled})
    for (Vector2d& p : *points) p *= 1000;
  const OutlineError a = outline_error(Outline(large), corners), b = outline_error(Outline(large), reversed),
                     c = outline_error(Outline(scaled_goal), scaled);
  EXPECT_NEAR(a.iou, b.iou, 1e-12);
  EXPECT_NEAR(a.iou, c.iou, 1e-6);
  EXPECT_NEAR(a.rms, c.rms, 1e-12);
  EXPECT_GT(a.iou, 0.1);
  EXPECT_LT(a.iou, 1);
}

TEST(OutlineError, IsNaNWhereThereIsNoPolygon) {
  const Outline goal(square(10));
  Points corners = square(10);
  corners[2].x() = NAN;
  const OutlineError of_nan = outline_error(goal, corners);
  EXPECT_TRUE(std::isnan(of_nan.rms) && std::isnan(of_nan.max) && std::isnan(of_nan.iou));
  const OutlineError crossed = outline_error(goal, {{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  EXPECT_EQ(crossed.rms, 0);
  EXPECT_EQ(crossed.max, 0);
  EXPECT_TRUE(std::isnan(crossed.iou));
  EXPECT_TRUE(std::isnan(outline_error(goal, {}).rms));
}

/// r(angle) = 1 + amplitude cos(folds (angle - direction)), off the origin.
Outline wavy(int folds, double amplitude, double direction, int points = 240) {
  std::vector<Vector2d> out;
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * pi * k / points;
    out.push_back(Vector2d(7, -3) + 40 * (1 + amplitude * std::cos(folds * (angle - direction))) *
                                        Vector2d(std::cos(angle), std::sin(angle)));
  }
  return Outline(out);
}

double apart(double a, double b, double period) { return std::abs(std::remainder(a - b, period)); }

TEST(DirectionOf, AnOutlineIsThatOfItsWaves) {
  for (const int folds : {2, 3, 4, 5, 6})
    for (const double direction : {0.0, 0.3, 1.1, -2.0}) {
      const auto found = direction_of(wavy(folds, 0.15, direction));
      ASSERT_TRUE(found.has_value()) << folds;
      EXPECT_LE(apart(*found, direction, 2 * pi / folds), 1e-6) << folds;
    }
}

TEST(DirectionOf, ADiscIsNothing) {
  EXPECT_FALSE(direction_of(wavy(72, 0, 0)).has_value());
  EXPECT_FALSE(direction_of(wavy(72, 0, 0, 24)).has_value());
}

TEST(DirectionOf, AnOutlineTurnsWithItAllRound) {
  const std::vector<Vector2d> shapes[] = {{{0, 0}, {60, 0}, {70, 25}, {10, 30}},
                                          {{0, 0}, {40, 0}, {40, 40}, {0, 40}},
                                          {{0, 0}, {50, 0}, {20, 10}},
                                          {{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}};
  const double periods[] = {2 * pi, pi / 2, 2 * pi, 2 * pi};
  for (int shape = 0; shape < 4; ++shape) {
    const Outline outline(shapes[shape]);
    const double first = direction_of(outline).value();
    for (const double angle : {0.2, 0.9, 2.5, -1.7, 3.1})
      EXPECT_LE(apart(direction_of(turned(outline, angle)).value(), first + angle, periods[shape]), 1e-9)
          << shape << " by " << angle;
  }
}

TEST(DirectionOf, AnEllipseIsItsLongAxisAndASquareItsDiagonal) {
  EXPECT_LE(apart(direction_of(wavy(2, 0.1, 0.4)).value(), 0.4, pi), 1e-6);
  EXPECT_LE(apart(direction_of(Outline({{0, 0}, {9, 0}, {9, 9}, {0, 9}})).value(), pi / 4, pi / 2), 1e-12);
}

TEST(SmallestDiagonal, IsThatOfTheBoxAsDrawnSquareAndTurnsWithIt) {
  const Outline rectangle({{0, 0}, {60, 0}, {60, 40}, {0, 40}}), square({{0, 0}, {30, 0}, {30, 30}, {0, 30}});
  for (const double angle : {0.0, 0.3, pi / 4, 2.0}) {
    EXPECT_NEAR(turned(rectangle, angle).diagonal(), std::hypot(60, 40), 1e-9);
    EXPECT_NEAR(turned(square, angle).diagonal(), std::hypot(30, 30), 1e-9);
  }
}

TEST(Turned, KeepsAreaAndPerimeter) {
  const Outline outline = wavy(3, 0.2, 0.5), by = turned(outline, 0.77);
  EXPECT_NEAR(by.area(), outline.area(), 1e-9 * outline.area());
  EXPECT_NEAR(by.perimeter(), outline.perimeter(), 1e-9 * outline.perimeter());
  EXPECT_EQ(turned(outline, 0).points()[3], outline.points()[3]);
}

}  // namespace
}  // namespace kinetix::targets
