#include "targets/surface/ribbed_surface.hpp"

#include <gtest/gtest.h>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

void expect_in_ribs_frame(const RibbedSurface& surface) {
  for (const Vector3d& p : surface.spine.points()) EXPECT_NEAR(p.x(), 0, 1e-9 * surface.diagonal);
  for (const Vector3d& end : {surface.spine.points().front(), surface.spine.points().back()})
    EXPECT_NEAR(end.z(), 0, 1e-9 * surface.diagonal);
  EXPECT_LT(surface.spine.points().front().y(), surface.spine.points().back().y());
}

TEST(RibbedSurface, LaysTheSpineOfACapOverItsTop) {
  const SurfacePatch cap = cap_patch(100, 60 * radians_per_degree);
  const RibbedSurface surface = ribbed_surface(cap);
  expect_in_ribs_frame(surface);
  const double radius = std::sqrt(2) * 50 / std::sin(30 * radians_per_degree);
  EXPECT_NEAR(surface.spine.length(), 2 * radius * std::asin(50 / radius), 0.01);
  EXPECT_NEAR(surface.spine.at(surface.spine.length() / 2).z(), radius - std::sqrt(radius * radius - 2500),
              1e-3);
  EXPECT_NEAR(surface.diagonal, cap.diagonal(), 0.01);
  for (const Vector3d& p : surface.spine.points()) {
    const Vector3d given = surface.to_given * p;
    EXPECT_NEAR(given.z(), cap.height(given.head<2>()).z, 0.01);
  }
}

TEST(RibbedSurface, LaysTheSpineOfAClosedMeshFromEndToEnd) {
  const RibbedSurface surface = ribbed_surface(testing::ellipsoid({20, 100, 40}, 96, 48));
  expect_in_ribs_frame(surface);
  EXPECT_NEAR(surface.area, 4 * pi * 2320, 0.1 * 4 * pi * 2320);  // Knud Thomsen: mean of products 2,320 mm^2
  EXPECT_GT(surface.spine.at(surface.spine.length() / 2).z(), 0);
  EXPECT_GT(surface.spine.length(), 190);
}

TEST(RibbedSurface, SectionsRunHalfWayRoundWhereTheyClose) {
  const TriangleMesh ball = joined(testing::ellipsoid({50, 50, 50}, 120, 60));
  const auto [lower, upper] = section_from(ball, {0, 0, 50}, Vector3d::UnitY());
  EXPECT_LT(lower[1].x(), 0);
  EXPECT_GT(upper[1].x(), 0);
  for (const auto* arm : {&lower, &upper}) {
    EXPECT_NEAR(SpaceCurve(*arm).length(), 50 * pi, 0.1);
    EXPECT_LE((arm->front() - Vector3d(0, 0, 50)).norm(), 0.1);
    EXPECT_LE((arm->back() - Vector3d(0, 0, -50)).norm(), 0.5);
  }
}

TEST(RibbedSurface, SectionsEndAtTheRim) {
  const TriangleMesh mesh = joined(patch_mesh(saddle_patch(100, 0.3)));
  const auto [lower, upper] = section_from(mesh, {20, 0, 2.4}, Vector3d::UnitY());
  EXPECT_NEAR(lower.back().x(), -50, 1e-9);
  EXPECT_NEAR(upper.back().x(), 50, 1e-9);
}

TEST(RibbedSurface, RefusesWhatHasNoArea) {
  EXPECT_THROW(ribbed_surface(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}), InvalidInput);
}

}  // namespace
}  // namespace kinetix::targets
