#include "targets/mesh/mesh_solid.hpp"

#include <gtest/gtest.h>

#include <random>

#include "targets/mesh/outer_skin.hpp"
#include "tests/targets/heads.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using testing::add_part;
using testing::ear_axes;
using testing::ear_centre;
using testing::ellipsoid;
using testing::head_axes;
using testing::head_with_thin_ears;
using testing::level;
using testing::random_point;

void turn_some(TriangleMesh& mesh, std::mt19937& random) {
  for (Triangle& triangle : mesh.triangles)
    if (random() % 2) std::swap(triangle[1], triangle[2]);
}

TEST(OuterSkin, LeavesAMeshThatIsWoundOutwardAsItIs) {
  for (const TriangleMesh& mesh : {head_with_thin_ears(), testing::lampshade(), testing::cube(50)}) {
    const TriangleMesh skin = outer_skin(mesh);
    EXPECT_EQ(skin.triangles, mesh.triangles);
    EXPECT_EQ(skin.vertices, mesh.vertices);
  }
}

TEST(OuterSkin, TurnsTrianglesOutwardHoweverTheyAreWound) {
  std::mt19937 random(31);
  for (const TriangleMesh& mesh :
       {head_with_thin_ears(), testing::lampshade(), testing::head_with_ears(90, 60)}) {
    TriangleMesh turned = mesh;
    turn_some(turned, random);
    const TriangleMesh skin = outer_skin(turned);
    ASSERT_EQ(skin.triangles.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      EXPECT_GT(area_normal(skin, t).dot(area_normal(mesh, t)), 0) << t;
  }
}

TEST(OuterSkin, IsWithoutInnerShellsAndDoubledTriangles) {
  const TriangleMesh outer = ellipsoid(head_axes);
  TriangleMesh mesh = outer;
  add_part(mesh, ellipsoid(0.9 * head_axes), Vector3d::Zero());
  for (std::size_t t = 0; t < 100; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, a});
    mesh.triangles.push_back({a, b, b});
  }
  EXPECT_EQ(outer_skin(mesh).triangles, outer.triangles);
}

TEST(MeshSolid, HoldsThinEarsAndNotWhatIsBesideThem) {
  std::mt19937 random(32);
  TriangleMesh mesh = head_with_thin_ears();
  turn_some(mesh, random);
  const MeshSolid solid(mesh);
  int in_ears = 0;
  for (int round = 0; round < 4000; ++round) {
    Vector3d p = random_point(random, 130);
    if (round % 2) {
      const Vector3d near_ear = ear_centre + 1.3 * ear_axes.cwiseProduct(random_point(random, 1));
      p = Vector3d(round % 4 == 1 ? 1 : -1, 1, 1).cwiseProduct(near_ear);
    }
    const double head = level(p, head_axes);
    const double ear = level(Vector3d(std::abs(p.x()), p.y(), p.z()) - ear_centre, ear_axes);
    if (std::abs(head - 1) < 0.01 || std::abs(ear - 1) < 0.05) continue;
    EXPECT_EQ(solid.contains(p), testing::is_in_head_or_ear(p)) << p.transpose();
    EXPECT_EQ(solid.distance(p) < 0, testing::is_in_head_or_ear(p)) << p.transpose();
    in_ears += head > 1 && ear < 1;
  }
  EXPECT_GT(in_ears, 50);
}

TEST(MeshSolid, OfAScanWithHolesIsTheHeadThatWasScanned) {
  std::mt19937 random(33);
  for (const unsigned seed : {1u, 2u, 3u}) {
    const MeshSolid solid(joined(testing::scanned_head(seed, 0.2, 12)));
    for (int round = 0; round < 1000; ++round) {
      const Vector3d p = random_point(random, 110);
      if (p.z() < -60 || p.norm() > 125 || std::abs(level(p, head_axes) - 1) < 0.06) continue;
      const bool is_near_ears_or_nose = level(p, head_axes) > 1 && p.z() < 30;
      if (is_near_ears_or_nose) continue;
      EXPECT_EQ(solid.contains(p), level(p, head_axes) < 1) << seed << ": " << p.transpose();
    }
  }
}

TEST(MeshSolid, OfAnOpenScanEndsAtThePlaneOfItsRim) {
  const TriangleMesh cap =
      testing::cut(ellipsoid(head_axes, 180, 120), [](const Vector3d& p) { return p.z() < 30; });
  const MeshSolid solid(cap);
  for (const double x : {0.0, 30.0, 60.0}) {
    EXPECT_TRUE(solid.contains({x, 0, 36}));
    EXPECT_FALSE(solid.contains({x, 0, 24}));
  }
  EXPECT_FALSE(solid.contains({0, 0, 116}));
  EXPECT_TRUE(solid.contains({0, 0, 114}));
}

}  // namespace
}  // namespace kinetix::targets
