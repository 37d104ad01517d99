#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <random>

#include "targets/mesh/triangle_tree.hpp"
#include "tests/support/derivatives.hpp"
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

using testing::ellipsoid;

TriangleMesh random_soup(std::mt19937& random, int triangles) {
  TriangleMesh mesh;
  for (int t = 0; t < triangles; ++t) {
    const Vector3d centre = random_point(random, 100);
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(centre + random_point(random, t % 7 == 0 ? 60 : 8));
    mesh.triangles.push_back({3 * t, 3 * t + 1, t % 11 == 0 ? 3 * t : 3 * t + 2});
  }
  return mesh;
}

/// Returns the distance to the nearest point of a dense sampling of the triangle's area.
double sampled_distance(const std::array<Vector3d, 3>& c, const Vector3d& p, int n = 60) {
  double least = 1e300;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      least = std::min(least, (c[0] + i * (c[1] - c[0]) / n + j * (c[2] - c[0]) / n - p).norm());
  return least;
}

TEST(NearestOnTriangle, IsNoFartherThanAnySampleAndOnTheTriangle) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    std::array<Vector3d, 3> c = {random_point(random, 5), random_point(random, 5), random_point(random, 5)};
    if (round % 5 == 0) c[2] = c[0] + 0.3 * (c[1] - c[0]);
    if (round % 7 == 0) c[1] = c[0];
    const Vector3d p = random_point(random, 9), q = nearest_on_triangle(c, p);
    const double sampled = sampled_distance(c, p), step = 10 * std::sqrt(3.0) / 60;
    EXPECT_LE((q - p).norm(), sampled + 1e-12);
    EXPECT_GE((q - p).norm(), sampled - step);
    EXPECT_LE(sampled_distance(c, q), step);
  }
}

TEST(TriangleTree, FindsTheSameNearestPlaceAsBruteForce) {
  std::mt19937 random(4);
  for (const int triangles : {1, 3, 40, 700}) {
    const TriangleMesh mesh = random_soup(random, triangles);
    const TriangleTree tree(mesh);
    for (int round = 0; round < 200; ++round) {
      const Vector3d p = random_point(random, 150);
      double least = 1e300;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        least = std::min(
            least, (nearest_on_triangle({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, p) - p)
                       .squaredNorm());
      const NearestPlace place = tree.nearest(p);
      EXPECT_EQ(place.squared_distance, least);
      EXPECT_NEAR((place.point - p).squaredNorm(), least, 1e-9);
    }
  }
}

TEST(TriangleTree, AnEllipsoidIsLeftWhereItsEquationSays) {
  const Vector3d axes(80, 100, 110);
  const TriangleTree tree(ellipsoid(axes, 200, 100));
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    const Vector3d direction = random_point(random, 1);
    const auto t = tree.farthest_hit(Vector3d::Zero(), direction);
    ASSERT_TRUE(t);
    EXPECT_NEAR(*t * (direction.array() / axes.array()).matrix().norm(), 1, 1e-3);
    EXPECT_FALSE(tree.farthest_hit(3 * *t * direction, direction));
  }
}

TEST(TriangleTree, NoRaySlipsThroughBetweenTriangles) {
  const TriangleMesh mesh = ellipsoid({80, 100, 110}, 24, 12);
  const TriangleTree tree(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      for (const double f : {0.0, 0.25, 0.5, 0.9}) {
        const Vector3d on_edge = (1 - f) * mesh.corner(t, k) + f * mesh.corner(t, (k + 1) % 3);
        const auto hit = tree.farthest_hit(Vector3d::Zero(), on_edge);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(*hit, 1, 1e-9);
      }
}

TEST(MeshDistance, OfASphereIsTheRadiusLess) {
  const double radius = 100;
  const MeshDistance distance(ellipsoid(Vector3d::Constant(radius), 240, 120), Vector3d::Zero());
  std::mt19937 random(6);
  for (int round = 0; round < 500; ++round) {
    const Vector3d p = random_point(random, 150);
    if (p.norm() < 40) continue;
    const ClosestMeshPoint closest = distance.closest(p);
    EXPECT_NEAR(closest.distance, p.norm() - radius, 0.03);
    EXPECT_NEAR(closest.face_normal.dot(p.normalized()), 1, 1e-3);
    EXPECT_NEAR((closest.point + closest.distance * closest.normal - p).norm(), 0, 1e-9);
  }
}

TEST(MeshDistance, HasOneOutsideHoweverTrianglesAreWound) {
  std::mt19937 random(7);
  TriangleMesh mesh = ellipsoid({80, 100, 110}, 60, 30);
  for (auto& triangle : mesh.triangles)
    if (random() % 2) std::swap(triangle[0], triangle[1]);
  const MeshDistance distance(mesh, {0, 0, 30});
  for (int round = 0; round < 300; ++round) {
    const Vector3d p = random_point(random, 140);
    const double level = (p.array() / Eigen::Array3d(80, 100, 110)).matrix().norm();
    if (level < 0.8 || std::abs(level - 1) < 0.01) continue;
    const ClosestMeshPoint closest = distance.closest(p);
    EXPECT_EQ(closest.distance > 0, level > 1) << p.transpose();
    EXPECT_GT(closest.normal.dot(closest.point), 0);
    EXPECT_GT(closest.face_normal.dot(closest.point), 0);
  }
}

TEST(MeshDistance, ChangesAsItsNormalSays) {
  std::mt19937 random(8);
  const MeshDistance distance(ellipsoid({80, 100, 110}, 60, 30), Vector3d::Zero());
  for (int round = 0; round < 50; ++round) {
    const Vector3d p = random_point(random, 140);
    if (p.norm() < 60) continue;
    const auto f = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, distance.closest(x).distance);
    };
    testing::expect_jacobian(f, p, distance.closest(p).normal.transpose(), 1e-4, 1e-4);
  }
}

TEST(MeshDistance, OfAPointOnTheMeshIsZeroWithTheTrianglesNormal) {
  const TriangleMesh mesh = ellipsoid({80, 100, 110}, 60, 30);
  const MeshDistance distance(mesh, Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 7) {
    const Vector3d centre = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
    const ClosestMeshPoint closest = distance.closest(centre);
    EXPECT_NEAR(closest.distance, 0, 1e-12);
    EXPECT_NEAR((closest.normal - area_normal(mesh, t).normalized()).norm(), 0, 1e-9);
  }
}

}  // namespace
}  // namespace kinetix::targets
