#include "targets/outline/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/base/angle.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

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
