#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "targets/mesh/mesh_solid.hpp"
#include "tests/targets/heads.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using testing::cube;
using testing::cut;
using testing::ellipsoid;
using testing::random_point;

constexpr double pi_ = std::numbers::pi;  // rad; 4 pi is the solid angle of all directions

WindingNumber winding_of(const TriangleMesh& mesh) { return WindingNumber(TriangleTree(mesh)); }

/// Sums the definition, triangle by triangle.
double summed(const TriangleMesh& mesh, const Vector3d& p) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += solid_angle({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, p);
  return sum / (4 * pi_);
}

/// Checks by another method: how often a ray crosses the mesh, in the plane of two coordinates.
bool is_inside_by_parity(const TriangleMesh& mesh, const Vector3d& p) {
  int crossings = 0;
  const auto side = [&](const Vector3d& a, const Vector3d& b) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    const double wa = side(b, c), wb = side(c, a), wc = side(a, b);
    if (!((wa > 0) == (wb > 0) && (wb > 0) == (wc > 0))) continue;
    crossings += (wa * a.z() + wb * b.z() + wc * c.z()) / (wa + wb + wc) > p.z();
  }
  return crossings % 2 == 1;
}

TEST(SolidAngle, OfAnOctantIsHalfARightAngleTimesPi) {
  for (const double size : {1e-3, 1.0, 1e4})
    EXPECT_NEAR(solid_angle({size * Vector3d::UnitX(), size * Vector3d::UnitY(), size * Vector3d::UnitZ()},
                            Vector3d::Zero()),
                pi_ / 2, 1e-14);
}

TEST(SolidAngle, ChangesItsSignWithTheWindingAndTheSide) {
  const std::array<Vector3d, 3> corners = {Vector3d(0, 0, 0), Vector3d(3, 0, 0), Vector3d(0, 4, 0)};
  const Vector3d p(1, 1, -0.5), mirrored(1, 1, 0.5);
  EXPECT_GT(solid_angle(corners, p), 0);
  EXPECT_NEAR(solid_angle(corners, mirrored), -solid_angle(corners, p), 1e-14);
  EXPECT_NEAR(solid_angle({corners[0], corners[2], corners[1]}, p), -solid_angle(corners, p), 1e-14);
}

TEST(SolidAngle, OfATriangleWithoutAreaAndAtACornerIsZero) {
  const Vector3d a(1, 2, 3), b(2, 3, 4);
  EXPECT_EQ(solid_angle({a, a, b}, Vector3d(0, 0, 1)), 0);
  EXPECT_EQ(solid_angle({a, b, Vector3d(5, 0, 0)}, a), 0);
}

TEST(WindingNumber, OfACubeIsOneInsideAndZeroOutsideUpToItsFaces) {
  const WindingNumber winding = winding_of(cube(10));
  std::mt19937 random(11);
  for (int round = 0; round < 500; ++round) {
    const Vector3d p = random_point(random, 15);
    EXPECT_NEAR(winding.at(p), p.cwiseAbs().maxCoeff() < 10 ? 1 : 0, 0.03) << p.transpose();
  }
  for (const double gap : {1e-3, 1e-9})
    for (int c = 0; c < 3; ++c)
      for (const double side : {-1.0, 1.0}) {
        Vector3d p(1, 2, 3);
        p[c] = side * (10 - gap);
        EXPECT_NEAR(winding.at(p), 1, 1e-3);
        p[c] = side * (10 + gap);
        EXPECT_NEAR(winding.at(p), 0, 1e-3);
      }
}

TEST(WindingNumber, OfASphereIsOneInsideAndZeroOutside) {
  const TriangleMesh sphere = ellipsoid(Vector3d::Constant(100), 60, 30);
  const WindingNumber winding = winding_of(sphere);
  std::mt19937 random(14);
  for (int round = 0; round < 500; ++round) {
    const Vector3d p = random_point(random, 130);
    if (std::abs(p.norm() - 100) < 1) continue;
    EXPECT_NEAR(winding.at(p), p.norm() < 100 ? 1 : 0, 0.04) << p.transpose();
    EXPECT_NEAR(summed(sphere, p), p.norm() < 100 ? 1 : 0, 1e-12) << p.transpose();
  }
}

TEST(WindingNumber, OfTwoShellsAddsUp) {
  TriangleMesh mesh = ellipsoid({60, 80, 90}, 60, 30);
  testing::add_part(mesh, ellipsoid(Vector3d::Constant(20), 40, 20), Vector3d::Zero());
  const WindingNumber winding = winding_of(mesh);
  EXPECT_NEAR(winding.at({1, 2, 3}), 2, 0.06);
  EXPECT_NEAR(winding.at({0, 50, 0}), 1, 0.06);
  EXPECT_NEAR(winding.at({0, 90, 0}), 0, 0.06);
}

/// A disc of radius R seen from its axis at height z takes up 2 pi (1 - z / sqrt(z^2 + R^2)).
TEST(WindingNumber, OfAnOpenHemisphereIsThatOfTheSphereLessTheDiscThatIsMissing) {
  const double radius = 100;
  const TriangleMesh half =
      cut(ellipsoid(Vector3d::Constant(radius), 240, 120), [](const Vector3d& p) { return p.z() < -1e-9; });
  const WindingNumber winding = winding_of(half);
  for (const double z : {-300.0, -50.0, -5.0, 0.0, 5.0, 40.0, 95.0}) {
    const double expected = (1 + z / std::hypot(z, radius)) / 2;
    EXPECT_NEAR(summed(half, {0, 0, z}), expected, 1e-3) << z;
    EXPECT_NEAR(winding.at({0, 0, z}), expected, 0.03) << z;
  }
}

TEST(WindingNumber, ByTheTreeIsNearTheSumOfAllTriangles) {
  std::mt19937 random(12);
  for (const TriangleMesh& mesh :
       {testing::head_with_thin_ears(), testing::lampshade(), testing::scanned_head(4)}) {
    const WindingNumber winding = winding_of(mesh);
    for (int round = 0; round < 100; ++round) {
      const Vector3d p = random_point(random, 130);
      EXPECT_NEAR(winding.at(p), summed(mesh, p), 0.06) << p.transpose();  // two shells
    }
  }
}

TEST(WindingNumber, AgreesWithTheParityOfARayOnClosedMeshes) {
  std::mt19937 random(13);
  TriangleMesh star = testing::globe(
      [](double azimuth, double polar) -> Vector3d {
        const double r = 60 * (1 + 0.5 * std::sin(5 * azimuth) * std::pow(std::sin(polar), 4));
        return r * Vector3d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                            std::cos(polar));
      },
      160, 80);
  for (const TriangleMesh& mesh : {star, ellipsoid({60, 5, 40}, 60, 30)}) {
    const WindingNumber winding = winding_of(mesh);
    int inside = 0;
    for (int round = 0; round < 1000; ++round) {
      const Vector3d p = random_point(random, 70);
      EXPECT_EQ(winding.at(p) > 0.5, is_inside_by_parity(mesh, p)) << p.transpose();
      inside += winding.at(p) > 0.5;
    }
    EXPECT_GT(inside, 10);
  }
}

using testing::add_part;
using testing::ear_axes;
using testing::ear_centre;
using testing::head_axes;
using testing::head_with_thin_ears;
using testing::level;

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
