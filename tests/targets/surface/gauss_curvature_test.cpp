#include "targets/surface/gauss_curvature.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

#include "model/base/geometry.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Sums the integrals over squares of a grid of the whole patch.
double whole_integral(const SurfacePatch& patch, int sides = 8) {
  double sum = 0;
  const Vector2d step = 2 * patch.half / sides;
  for (int j = 0; j < sides; ++j)
    for (int i = 0; i < sides; ++i) {
      const Vector2d low = -patch.half + Vector2d(i * step.x(), j * step.y());
      sum +=
          gauss_integral(patch, {low, low + Vector2d(step.x(), 0), low + step, low + Vector2d(0, step.y())});
    }
  return sum;
}

PointGrid grid_of(int columns, int rows, const Vector2d& half,
                  const std::function<Vector3d(double, double)>& at) {
  PointGrid grid{columns, rows, {}};
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      grid.points.push_back(at(half.x() * (2.0 * i / columns - 1), half.y() * (2.0 * j / rows - 1)));
  return grid;
}

PointGrid grid_on(const SurfacePatch& patch, int facets = 8) {
  return grid_of(facets, facets, patch.half, [&](double x, double y) {
    return Vector3d(x, y, patch.height({x, y}).z);
  });
}

SurfacePatch cylinder(double half, double radius) {
  return {"cylinder", {half, half}, [radius](const Vector2d& at) {
            const double z = std::sqrt(radius * radius - at.y() * at.y());
            Height h{z - radius, {0, -at.y() / z}};
            h.bending(1, 1) = -radius * radius / (z * z * z);
            return h;
          }};
}

// Omega = (4 / R) (2 a asin(a / sqrt(R^2 - a^2)) - R atan(a^2 / (R sqrt(R^2 - 2 a^2)))), the part of a sphere over a square.
TEST(GaussIntegral, OfACapIsItsSolidAngle) {
  for (const double arc : {0.3, 0.7, 1.2, 2.0}) {
    const double a = 50, radius = std::sqrt(2.0) * a / std::sin(arc / 2);
    const double omega = 4 / radius *
                         (2 * a * std::asin(a / std::sqrt(radius * radius - a * a)) -
                          radius * std::atan(a * a / (radius * std::sqrt(radius * radius - 2 * a * a))));
    EXPECT_NEAR(whole_integral(cap_patch(2 * a, arc), 16), omega, 1e-5 * omega) << arc;
  }
}

// Its normals sweep a pyramid of slopes up to s = 2 rise: -4 atan(s^2 / sqrt(1 + 2 s^2)).
TEST(GaussIntegral, OfASaddleIsTheSolidAngleOfItsNormalsBelowZero) {
  for (const double rise : {0.05, 0.15, 0.5}) {
    const double s = 2 * rise, omega = 4 * std::atan(s * s / std::sqrt(1 + 2 * s * s));
    EXPECT_NEAR(whole_integral(saddle_patch(80, rise)), -omega, 1e-8 * omega) << rise;
  }
}

TEST(GaussIntegral, OfACylinderIsNothing) { EXPECT_EQ(whole_integral(cylinder(40, 60)), 0); }

TEST(GaussIntegral, IsTheSumOfItsPartsInAnyShape) {
  const SurfacePatch cap = cap_patch(100, 0.8);
  const std::array<Vector2d, 4> whole = {Vector2d(-30, -20), {25, -28}, {31, 22}, {-22, 30}};
  const Vector2d low = (whole[0] + whole[1]) / 2, high = (whole[2] + whole[3]) / 2;
  EXPECT_NEAR(gauss_integral(cap, whole),
              gauss_integral(cap, {whole[0], low, high, whole[3]}) +
                  gauss_integral(cap, {low, whole[1], whole[2], high}),
              1e-5);
}

TEST(AngleDefects, OfAPlaneAndOfACylinderAreNothing) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-2, 2);
  const PointGrid flat = grid_of(
      6, 5, {30, 25}, [&](double x, double y) { return Vector3d(x + off(random), y + off(random), 3); });
  for (const double defect : angle_defects(flat)) EXPECT_NEAR(defect, 0, 1e-13);
  const PointGrid rolled = grid_on(cylinder(40, 60));
  EXPECT_EQ(angle_defects(rolled).size(), 49u);
  for (const double defect : angle_defects(rolled)) EXPECT_NEAR(defect, 0, 1e-13);
}

// A pyramid over a square of diagonal 2, h high: each corner at its tip is acos(h^2 / (1 + h^2)).
TEST(AngleDefects, OfATipIsWhatItsCornersLackOfAWholeTurn) {
  for (const double h : {0.1, 1.0, 3.0}) {
    PointGrid tip{2, 2, {}};
    for (const int j : {-1, 0, 1})
      for (const int i : {-1, 0, 1}) tip.points.emplace_back(i, j, i == 0 && j == 0 ? h : 0);
    ASSERT_EQ(angle_defects(tip).size(), 1u);
    EXPECT_NEAR(angle_defects(tip)[0], 2 * pi - 4 * std::acos(h * h / (1 + h * h)), 1e-13);
  }
}

TEST(AngleDefects, OfASphereSumUpToItsSolidAngle) {
  const SurfacePatch cap = cap_patch(100, 0.7);
  double sum = 0;
  for (const double defect : angle_defects(grid_on(cap, 40))) sum += defect;
  SurfacePatch inner = cap;
  inner.half *= 39.0 / 40;
  EXPECT_NEAR(sum, whole_integral(inner), 2e-3 * sum);
}

TEST(GaussShare, IsAllOfItOnTheSurfaceItself) {
  for (const SurfacePatch& patch : {cap_patch(100, 0.7), saddle_patch(100, 0.15), vase_patch(120, 50, 10, 1)})
    EXPECT_GE(gauss_share(patch, grid_on(patch, 12)).share, 0.97) << patch.name;
}

TEST(GaussShare, IsNothingOfAFlatOrRolledSheet) {
  const double half = 50;
  for (const SurfacePatch& patch : {cap_patch(2 * half, 0.7), saddle_patch(2 * half, 0.15)}) {
    const PointGrid flat = grid_of(8, 8, patch.half, [](double x, double y) { return Vector3d(x, y, 0); });
    EXPECT_NEAR(gauss_share(patch, flat).share, 0, 1e-12) << patch.name;
    EXPECT_NEAR(gauss_share(patch, grid_on(cylinder(half, 200))).share, 0, 1e-12) << patch.name;
  }
}

TEST(GaussShare, IsHalfOnASphereOfHalfTheCurvature) {
  const double width = 100, arc = 0.7, radius = width / std::sqrt(2.0) / std::sin(arc / 2);
  const SurfacePatch half =
      cap_patch(width, 2 * std::asin(width / 2 / radius));  // of sqrt(2) times the radius
  EXPECT_NEAR(gauss_share(cap_patch(width, arc), grid_on(half)).share, 0.5, 0.03);
}

TEST(GaussShare, IsNothingOfABowlForASaddleAndOfTheLessSignOfAVase) {
  EXPECT_EQ(gauss_share(saddle_patch(100, 0.15), grid_on(cap_patch(100, 0.7))).share, 0);
  const SurfacePatch vase = vase_patch(120, 50, 10, 1);
  // The belly alone: beyond the middle the rings are those of the middle.
  const PointGrid belly = grid_of(12, 12, vase.half, [&](double x, double y) {
    return Vector3d(x, y, vase.height({std::max(x, 0.0), y}).z);
  });
  EXPECT_LE(gauss_share(vase, belly).share, 0.2);
}

TEST(GaussShare, WantsLittleOfSurfacesThatHardlyCurve) {
  EXPECT_LT(gauss_share(cap_patch(100, 0.2), grid_on(cap_patch(100, 0.2))).wanted,
            double_curvature_threshold);
  EXPECT_GT(gauss_share(cap_patch(100, 0.7), grid_on(cap_patch(100, 0.7))).wanted,
            double_curvature_threshold);
  EXPECT_TRUE(std::isnan(gauss_share(cylinder(40, 60), grid_on(cylinder(40, 60))).share));
}

}  // namespace
}  // namespace kinetix::targets
