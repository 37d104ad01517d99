#include "targets/surface/surface_patch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::HasSubstr;

TEST(SurfacePatch, HasTheDerivativesOfItsHeights) {
  for (const SurfacePatch& patch : {cap_patch(2, 1.2), saddle_patch(2, 0.4), vase_patch(2.4, 1, 0.2, 1)})
    for (const Vector2d& at : {Vector2d(0.1, 0.2), Vector2d(-0.6, 0.35)}) {
      const auto height = [&](const Eigen::VectorXd& x) {
        const Height h = patch.height(x);
        return Eigen::Vector3d(h.z, h.slope.x(), h.slope.y());
      };
      Eigen::MatrixXd J(3, 2);
      J << patch.height(at).slope.transpose(), patch.height(at).bending;
      testing::expect_jacobian(height, at, J);
    }
}

TEST(CapPatch, IsASphereThatTurnsByItsArcFromCornerToCorner) {
  const double arc = 1, radius = std::sqrt(2.0) * 50 / std::sin(arc / 2);
  const SurfacePatch cap = cap_patch(100, arc);
  const auto [first, second] = principal_curvatures(cap.height({20, -10}));
  EXPECT_NEAR(first, -1 / radius, 1e-12);
  EXPECT_NEAR(second, -1 / radius, 1e-12);
  const Vector3d at_corner = closest_surface_point(cap, {50, 50, cap.height({50, 50}).z}).normal;
  EXPECT_NEAR(std::acos(at_corner.z()), arc / 2, 1e-12);
}

TEST(SurfacePatch, MeasuresDistancesAlongNormals) {
  const SurfacePatch saddle = saddle_patch(100, 0.3);
  for (const Vector2d& at : {Vector2d(10, 20), Vector2d(-45, 30)}) {
    const Height h = saddle.height(at);
    const Vector3d normal = Vector3d(-h.slope.x(), -h.slope.y(), 1).normalized();
    const ClosestSurfacePoint closest =
        closest_surface_point(saddle, Vector3d(at.x(), at.y(), h.z) + 5 * normal);
    EXPECT_NEAR(closest.distance, 5, 1e-9);
    EXPECT_NEAR((closest.at - at).norm(), 0, 1e-9);
  }
}

TriangleMesh sampled(const SurfacePatch& patch, int n) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Vector2d at(patch.half.x() * (2.0 * i / n - 1), patch.half.y() * (2.0 * j / n - 1));
      mesh.vertices.emplace_back(at.x(), at.y(), patch.height(at).z);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

TEST(MeshPatch, IsTheSurfaceThatItWasSampledFrom) {
  const SurfacePatch cap = cap_patch(100, 1), mesh = mesh_patch(sampled(cap, 16));
  EXPECT_NEAR(mesh.half.x(), 50, 1e-6);
  EXPECT_NEAR(mesh.half.y(), 50, 1e-6);
  const double shift = mesh.height({0, 0}).z - cap.height({0, 0}).z;
  for (const Vector2d& at : {Vector2d(20, 10), Vector2d(-40, 45)})
    EXPECT_NEAR(mesh.height(at).z - shift, cap.height(at).z, 0.01);
}

TEST(MeshPatch, LeavesOutTrianglesThatHaveACornerTwice) {
  const TriangleMesh whole = sampled(cap_patch(100, 1), 8);
  TriangleMesh with_pole = whole;
  for (int k = 0; k < 3; ++k) {
    with_pole.vertices.push_back(whole.vertices[40]);
    with_pole.triangles.push_back({40, static_cast<int>(with_pole.vertices.size()) - 1, 41});
  }
  const SurfacePatch plain = mesh_patch(whole), same = mesh_patch(with_pole);
  EXPECT_EQ(same.half, plain.half);
  EXPECT_EQ(same.height({10, 20}).z, plain.height({10, 20}).z);
}

TEST(MeshPatch, RefusesWhatIsNoSingleOpenSmoothSurface) {
  TriangleMesh closed;
  closed.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  closed.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  EXPECT_THROW(mesh_patch(closed), InvalidInput);
  TriangleMesh holed = sampled(cap_patch(100, 1), 8);
  holed.triangles.erase(holed.triangles.begin() + 60);
  EXPECT_THROW(mesh_patch(holed), InvalidInput);
  TriangleMesh rough = sampled(cap_patch(100, 1), 16);
  for (std::size_t v = 0; v < rough.vertices.size(); v += 2) rough.vertices[v].z() += 8;
  EXPECT_THROW(mesh_patch(rough), InvalidInput);
}

/// A strip of quadrilaterals over a line in the plane of x and z.
TriangleMesh strip_over(const std::vector<Vector2d>& line) {
  TriangleMesh mesh;
  for (const Vector2d& p : line)
    for (const double y : {0.0, 30.0}) mesh.vertices.emplace_back(p.x(), y, p.y());
  for (int k = 0; k + 1 < static_cast<int>(line.size()); ++k) {
    mesh.triangles.push_back({2 * k, 2 * k + 2, 2 * k + 1});
    mesh.triangles.push_back({2 * k + 1, 2 * k + 2, 2 * k + 3});
  }
  return mesh;
}

TEST(MeshPatch, SaysHowAMeshIsNoSurfaceOverItsPlane) {
  const auto refused = [](const TriangleMesh& bad) { return testing::refusal([&] { mesh_patch(bad); }); };
  TriangleMesh third = sampled(cap_patch(100, 1), 4);
  third.vertices.emplace_back(0, 0, 90);
  third.triangles.push_back({0, 6, static_cast<int>(third.vertices.size()) - 1});
  EXPECT_THAT(refused(third), HasSubstr("an edge of the mesh has more than two triangles"));
  TriangleMesh turned = sampled(cap_patch(100, 1), 4);
  std::swap(turned.triangles[0][1], turned.triangles[0][2]);
  EXPECT_THAT(refused(turned), HasSubstr("different orientations"));
  EXPECT_THAT(refused(strip_over({{0, 0}, {200, 0}, {400, 0}, {401, 30}})),
              HasSubstr("turns by 80 deg or more from the mean normal"));
}

}  // namespace
}  // namespace kinetix::targets
