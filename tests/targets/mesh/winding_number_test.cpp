#include "targets/mesh/winding_number.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

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

}  // namespace
}  // namespace kinetix::targets
