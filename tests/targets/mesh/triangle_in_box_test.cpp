#include "targets/mesh/triangle_in_box.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "targets/mesh/triangle_tree.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using testing::random_point;

OrientedBox random_box(std::mt19937& random) {
  const Vector3d axis = random_point(random, 1).normalized();
  return {random_point(random, 3), Eigen::AngleAxisd(random_point(random, 3).x(), axis).toRotationMatrix(),
          Vector3d(0.2, 0.2, 0.2) + random_point(random, 2).cwiseAbs()};
}

/// How far p is outside of the box, in the largest coordinate; < 0 inside.
double beyond(const OrientedBox& box, const Vector3d& p) {
  return ((box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half).maxCoeff();
}

double sampled(const OrientedBox& box, const std::array<Vector3d, 3>& c, int n) {
  double least = 1e300;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      least = std::min(least, beyond(box, c[0] + i * (c[1] - c[0]) / n + j * (c[2] - c[0]) / n));
  return least;
}

TEST(TriangleInBox, AgreesWithSamplesOfTheTriangle) {
  std::mt19937 random(21);
  int hits = 0, misses = 0;
  for (int round = 0; round < 2000; ++round) {
    std::array<Vector3d, 3> c = {random_point(random, 5), random_point(random, 5), random_point(random, 5)};
    if (round % 5 == 0) c[2] = c[0] + 0.3 * (c[1] - c[0]);
    if (round % 7 == 0) c[1] = c[0];
    const OrientedBox box = random_box(random);
    const double least = sampled(box, c, 100), step = 10 * std::sqrt(3.0) / 100;
    const bool touches = least <= 0;
    if (touches || least > step) {
      EXPECT_EQ(is_in_box(c, box), touches);
    }
    ++(touches ? hits : misses);
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 100);
}

TEST(TriangleInBox, SeesAnEdgeThatRunsThroughWithoutACornerInside) {
  const OrientedBox box{Vector3d::Zero(), Eigen::Matrix3d::Identity(), Vector3d(1, 2, 3)};
  EXPECT_TRUE(is_in_box({Vector3d(-9, 0, 0), Vector3d(9, 0, 0), Vector3d(0, 90, 0)}, box));
  EXPECT_TRUE(is_in_box({Vector3d(-99, -99, 0), Vector3d(99, -99, 0), Vector3d(0, 99, 0)}, box));
  EXPECT_FALSE(is_in_box({Vector3d(-9, 0, 3.1), Vector3d(9, 0, 3.1), Vector3d(0, 90, 3.1)}, box));
  EXPECT_FALSE(is_in_box({Vector3d(3.1, 0, 0), Vector3d(0, 3.1, 0), Vector3d(9, 9, 0)}, box));
}

TEST(TriangleTree, TouchesABoxWhereATriangleDoes) {
  std::mt19937 random(22);
  const TriangleMesh mesh = testing::ellipsoid({2, 3, 4}, 24, 12);
  const TriangleTree tree(mesh);
  for (int round = 0; round < 500; ++round) {
    OrientedBox box = random_box(random);
    box.half *= 0.3;
    bool touches = false;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      touches = touches || is_in_box({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, box);
    EXPECT_EQ(tree.touches(box), touches);
  }
}

TEST(TriangleTree, IsHitWhereItHasAFarthestHit) {
  std::mt19937 random(23);
  const TriangleTree tree(testing::ellipsoid({2, 3, 4}, 24, 12));
  for (int round = 0; round < 500; ++round) {
    const Vector3d origin = random_point(random, 6), direction = random_point(random, 1);
    EXPECT_EQ(tree.is_hit(origin, direction), tree.farthest_hit(origin, direction).has_value());
  }
}

}  // namespace
}  // namespace kinetix::targets
