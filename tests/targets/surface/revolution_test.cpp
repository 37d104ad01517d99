#include "targets/surface/revolution.hpp"

#include <gtest/gtest.h>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Points on a circle about (0, 0).
Profile ball(double radius, double up_to, int points) {
  std::vector<Vector2d> line;
  for (int k = 0; k < points; ++k) {
    const double z = up_to * (2.0 * k / (points - 1) - 1);
    line.emplace_back(std::sqrt(radius * radius - z * z), z);
  }
  return Profile(line);
}

TEST(Profile, GoesThroughItsPointsAndIsSmooth) {
  const Profile profile({{30, 0}, {45, 20}, {40, 50}, {20, 70}});
  EXPECT_NEAR(profile.radius(20)[0], 45, 1e-12);
  EXPECT_NEAR(profile.radius(70)[0], 20, 1e-12);
  const double h = 1e-4;
  for (const double z : {-5.0, 3.0, 19.0, 35.0, 69.0, 75.0}) {
    const auto [r, slope, bend] = profile.radius(z);
    EXPECT_NEAR(slope, (profile.radius(z + h)[0] - profile.radius(z - h)[0]) / (2 * h), 1e-7) << z;
    EXPECT_NEAR(bend, (profile.radius(z + h)[1] - profile.radius(z - h)[1]) / (2 * h), 1e-7) << z;
  }
  for (const double z : {0.0, 20.0, 50.0, 70.0})
    for (const int k : {0, 1, 2})
      EXPECT_NEAR(profile.radius(z - 1e-9)[k], profile.radius(z + 1e-9)[k], 1e-7) << z << " " << k;
}

TEST(Profile, RefusesWhatIsNoProfile) {
  EXPECT_THROW(Profile({{1, 0}}), InvalidCurve);
  EXPECT_THROW(Profile({{1, 0}, {1, 0}}), InvalidCurve);
  EXPECT_THROW(Profile({{1, 0}, {0, 1}}), InvalidCurve);
  EXPECT_THROW(Profile({{50, 0}, {50, 10}, {0.5, 11}, {0.5, 21}}), InvalidCurve);
}

TEST(Revolution, OfACircleIsASphere) {
  const SurfacePatch patch = revolution_patch(ball(50, 25, 21), 60 * radians_per_degree);
  for (const Vector2d& at : {Vector2d(0, 0), Vector2d(10, 15), Vector2d(-20, 5)}) {
    const Height height = patch.height(at);
    EXPECT_NEAR(height.z + 50, std::sqrt(2500 - at.squaredNorm()), 2e-3);
    if (std::abs(at.x()) > 12) continue;  // nearer to its ends the spline turns straight
    for (const double curvature : principal_curvatures(height)) EXPECT_NEAR(curvature, -1 / 50.0, 5e-4);
  }
  // Natural ends are straight: there it is between the circle and its chord, 2.5 mm long along the axis.
  const double bend = 2500 / std::pow(2500 - 625, 1.5), chord = 2.5 * 2.5 * bend / 8;
  for (const Vector3d& p : revolution_mesh(ball(50, 25, 21), 2 * pi).vertices)
    EXPECT_NEAR(p.norm(), 50, std::abs(p.x()) < 12 ? 1e-4 : chord);
}

// Regression: the radius in the middle decided where heights continue as a parabola, so a narrow end was not round.
TEST(Revolution, IsRoundAtItsNarrowEndsToo) {
  const Profile spindle({{10, 0}, {50, 60}, {10, 120}});
  const double turn = 59 * radians_per_degree;
  const SurfacePatch patch = revolution_patch(spindle, 2 * turn);
  for (const double x : {-60.0, 60.0})
    EXPECT_NEAR(patch.height({x, 10 * std::sin(turn)}).z + 50, 10 * std::cos(turn), 1e-9);
}

TEST(Revolution, RibsOfAConeCoverItsSide) {
  const RibbedSurface cone = ribbed_revolution(Profile({{20, 0}, {30, 100}}), 2 * pi);
  EXPECT_NEAR(cone.area, pi * 50 * std::hypot(10, 100), 1e-3 * cone.area);
  EXPECT_NEAR(cone.spine.length(), std::hypot(10, 100), 1e-9);
  EXPECT_GT((cone.to_given * cone.spine.at(50)).z(), 0);
  EXPECT_NEAR(ribbed_revolution(Profile({{20, 0}, {30, 100}}), pi / 2).area, cone.area / 4, 1e-3 * cone.area);
}

TEST(Revolution, RefusesArcsOutOfRange) {
  EXPECT_THROW(revolution_patch(Profile({{20, 0}, {30, 100}}), 2.2), InvalidInput);
  EXPECT_THROW(revolution_mesh(Profile({{20, 0}, {30, 100}}), 6.4), InvalidInput);
}

}  // namespace
}  // namespace kinetix::targets
