#include "targets/mesh/mesh_section.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "targets/curve/space_curve.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using testing::ellipsoid;

Plane plane_through(const Vector3d& point, const Vector3d& normal) {
  return Plane(normal.normalized(), point);
}

double length(const SectionChain& chain) {
  double sum = chain.is_closed ? (chain.points.front() - chain.points.back()).norm() : 0;
  for (std::size_t k = 1; k < chain.points.size(); ++k) sum += (chain.points[k] - chain.points[k - 1]).norm();
  return sum;
}

double total_length(const std::vector<SectionChain>& chains) {
  double sum = 0;
  for (const SectionChain& chain : chains) sum += length(chain);
  return sum;
}

TEST(MeshSection, OfASphereIsTheCircleOfEveryPlane) {
  const TriangleMesh sphere = ellipsoid({100, 100, 100}, 240, 120);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 30; ++round) {
    const Vector3d n = Vector3d(normal(random), normal(random), normal(random)).normalized();
    const double offset = -90 + 6 * round, radius = std::sqrt(1e4 - offset * offset);
    const auto chains = section(sphere, plane_through(offset * n, n));
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_TRUE(chains[0].is_closed);
    EXPECT_NEAR(length(chains[0]), 2 * std::numbers::pi * radius, 20 / radius);
    for (const Vector3d& p : chains[0].points) {
      EXPECT_NEAR(p.dot(n), offset, 1e-9);
      EXPECT_NEAR(p.norm(), 100, 0.03);
    }
  }
}

TEST(MeshSection, RunsThroughVerticesThatLieOnThePlane) {
  const TriangleMesh mesh = ellipsoid({80, 100, 110}, 24, 12);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d n = Vector3d::Unit(axis);
    const auto chains = section(mesh, plane_through(Vector3d::Zero(), n));
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_TRUE(chains[0].is_closed);
    for (const Vector3d& p : mesh.vertices) {
      if (std::abs(p[axis]) > 1e-9) continue;
      const auto is_p = [&](const Vector3d& q) { return (p - q).norm() < 1e-9; };
      EXPECT_EQ(std::count_if(chains[0].points.begin(), chains[0].points.end(), is_p), 1) << p.transpose();
    }
  }
  EXPECT_TRUE(section(mesh, plane_through({0, 0, 110.1}, Vector3d::UnitZ())).empty());
}

TEST(MeshSection, EndsAtHoles) {
  TriangleMesh mesh = ellipsoid({100, 100, 100}, 60, 30);
  const double whole = total_length(section(mesh, plane_through({0, 0, 20.5}, Vector3d::UnitZ())));
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Vector3d centre = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    return std::abs(centre.x()) > 60 && std::abs(centre.y()) < 20;
  });
  const auto chains = section(mesh, plane_through({0, 0, 20.5}, Vector3d::UnitZ()));
  ASSERT_EQ(chains.size(), 2u);
  for (const SectionChain& chain : chains) EXPECT_FALSE(chain.is_closed);
  EXPECT_NEAR(total_length(chains), whole - 4 * 100 * std::asin(20 / std::sqrt(1e4 - 20.5 * 20.5)), 25);
}

TEST(MeshSection, IsTheSameForTrianglesDoubledTurnedAndWithoutArea) {
  TriangleMesh mesh = ellipsoid({80, 100, 110}, 24, 12);
  const Plane plane = plane_through({3, 4, 5}, {1, 2, 3});
  const double whole = total_length(section(mesh, plane));
  const auto triangles = mesh.triangles;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const auto [a, b, c] = triangles[t];
    mesh.triangles.push_back({b, a, c});
    mesh.triangles.push_back({a, b, b});
    mesh.triangles.push_back({c, c, c});
  }
  const auto chains = section(mesh, plane);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_DOUBLE_EQ(length(chains[0]), whole);
}

TEST(MeshSection, KeepsEveryLineWhereSheetsMeet) {
  TriangleMesh mesh = ellipsoid({80, 100, 110}, 24, 12);
  const Plane plane = plane_through({0, 0, 1}, Vector3d::UnitZ());
  const double whole = total_length(section(mesh, plane));
  const Triangle t = mesh.triangles[mesh.triangles.size() / 2];
  mesh.vertices.push_back(1.3 * mesh.vertices[t[0]] + Vector3d(0, 0, 9));
  mesh.triangles.push_back({t[0], t[1], static_cast<int>(mesh.vertices.size()) - 1});
  EXPECT_GT(total_length(section(mesh, plane)), whole + 1);
}

TEST(SpaceCurve, OfAHelixHasTheArcLengthOfTheClosedForm) {
  std::vector<Vector3d> points;
  for (int k = 0; k <= 4000; ++k) {
    const double a = k * 1e-3;
    points.emplace_back(30 * std::cos(a), 30 * std::sin(a), 40 * a);
    if (k % 5 == 0) points.push_back(points.back());
  }
  const SpaceCurve curve(points, -50);
  EXPECT_EQ(curve.points().size(), 4001u);
  EXPECT_NEAR(curve.last(), 150, 1e-4);
  EXPECT_LE((curve.at(0) - Vector3d(30 * std::cos(1), 30 * std::sin(1), 40)).norm(), 1e-4);
  EXPECT_LE((curve.direction(0, 2) - Vector3d(-0.6 * std::sin(1), 0.6 * std::cos(1), 0.8)).norm(), 1e-3);
  EXPECT_NEAR(curve.nearest(curve.at(33)), 33, 1e-9);
  EXPECT_EQ(curve.at(-1000), points.front());
}

TEST(SpaceCurve, PartsAndEvenPointsKeepTheirPlaces) {
  const SpaceCurve curve({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}, -2);
  const SpaceCurve part = curve.part(-1, 3);
  EXPECT_EQ(part.first(), -1);
  EXPECT_NEAR(part.last(), 3, 1e-12);
  for (const double s : {-1.0, 0.5, 1.5, 2.9}) EXPECT_LE((part.at(s) - curve.at(s)).norm(), 1e-12);
  const auto even = curve.evenly(8);
  ASSERT_EQ(even.size(), 8u);
  EXPECT_LE((even[3] - Vector3d(3, 0, 0)).norm(), 1e-12);
  EXPECT_LE((even[7] - Vector3d(3, 4, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace kinetix::targets
