#include "targets/helmet/head.hpp"

#include <gmock/gmock.h>

#include "tests/support/bad_input.hpp"
#include "tests/targets/heads.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using testing::ellipsoid;
using ::testing::HasSubstr;
using testing::head_axes;
using testing::head_with_ears;
using testing::scanned_head;

/// How far p is from the ellipsoid of the head, mm, to first order.
double off_ellipsoid(const Vector3d& p) {
  const Vector3d scaled = p.cwiseQuotient(head_axes), gradient = scaled.cwiseQuotient(head_axes);
  return (scaled.squaredNorm() - 1) / (2 * gradient.norm());
}

double off_ellipsoid(const Head& head, const SpaceCurve& curve, double reach) {
  double worst = 0;
  for (double l = -reach; l <= reach; l += 1)
    worst = std::max(worst, std::abs(off_ellipsoid(head.to_mesh * curve.at(l))));
  return worst;
}

/// Arc length of the ellipse (a cos u, b sin u) from its end on b over the angle u.
double arc_of_ellipse(double a, double b, double u) {
  double sum = 0;
  for (int k = 0; k < 100000; ++k) {
    const double v = u * (k + 0.5) / 100000;
    sum += std::hypot(a * std::cos(v), b * std::sin(v)) * u / 100000;
  }
  return sum;
}

TEST(Head, OfASphereHasCirclesForProfileAndSections) {
  const Head head = make_head(ellipsoid({100, 100, 100}, 360, 180), {});
  EXPECT_NEAR(head.closed_part, 0, 0);
  EXPECT_LE((head.to_mesh.translation() - Vector3d(0, 0, 100)).norm(), 1e-9);
  for (double s = -90; s <= 90; s += 15) {
    const Vector3d expected(0, 100 * std::sin(s / 100), 100 * std::cos(s / 100) - 100);
    EXPECT_LE((head.profile.at(s) - expected).norm(), 0.03) << s;
    const SpaceCurve across = cross_section(head, s, 10);
    for (double l = -90; l <= 90; l += 15) {
      const Vector3d outward = std::cos(l / 100) * Vector3d(0, std::sin(s / 100), std::cos(s / 100));
      EXPECT_LE((across.at(l) - Vector3d(100 * std::sin(l / 100), 0, -100) - 100 * outward).norm(), 0.1)
          << s << " " << l;
    }
  }
}

TEST(Head, ProfileAndCrownSectionOfAnEllipsoidHaveTheLengthOfTheEllipses) {
  const Head head = make_head(ellipsoid(head_axes, 360, 240), {});
  const auto at_angle = [&](int axis, double u) {
    Vector3d p(0, 0, 115 * std::cos(u));
    p[axis] = head_axes[axis] * std::sin(u);
    return Vector3d(head.to_mesh.inverse() * p);
  };
  const SpaceCurve across = cross_section(head, 0, 10);
  for (const double u : {0.2, 0.5, 0.8, 1.1, 1.4}) {
    EXPECT_NEAR(head.profile.nearest(at_angle(1, u)), arc_of_ellipse(98, 115, u), 0.1);
    EXPECT_NEAR(across.nearest(at_angle(0, u)), arc_of_ellipse(77, 115, u), 0.1);
  }
}

TEST(Head, MirroredSectionsAreMirrorImages) {
  const Head head = make_head(head_with_ears(), {});
  for (const double s : {-80.0, -30.0, 0.0, 55.0}) {
    const SpaceCurve across = cross_section(head, s, 10);
    for (double l = 5; l <= 80; l += 5) {
      const Vector3d left = across.at(-l), right = across.at(l);
      EXPECT_LE((left - Vector3d(-right.x(), right.y(), right.z())).norm(), 0.05) << s << " " << l;
    }
  }
}

TEST(Head, SectionsAboveTheEarsKnowNothingOfEarsAndNose) {
  const Head head = make_head(head_with_ears(), {});
  EXPECT_LE(off_ellipsoid(head, head.profile, 90), 0.15);
  for (const double s : {-90.0, -45.0, 0.0, 45.0, 90.0})
    EXPECT_LE(off_ellipsoid(head, cross_section(head, s, 10), 85), 0.15) << s;
}

TEST(Head, NoiseHolesFlapsAndInnerShellsMoveItsSectionsByLittleMoreThanTheNoise) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Head head = make_head(scanned_head(seed, 0.2, 12), {});
    EXPECT_GT(head.closed_part, 0) << seed;
    EXPECT_LE(off_ellipsoid(head, head.profile, 90), 1.2) << seed;
    for (const double s : {-90.0, -45.0, 0.0, 45.0, 90.0})
      EXPECT_LE(off_ellipsoid(head, cross_section(head, s, 10), 85), 1.2) << seed << " " << s;
  }
}

TEST(Head, ClosesAHoleNearlyAsTheHeadWas) {
  TriangleMesh mesh = ellipsoid(head_axes, 360, 240);
  for (const Vector3d& centre : {Vector3d(0, 0, 115), Vector3d(0, 85, 57), Vector3d(60, 20, 65)})
    std::erase_if(mesh.triangles,
                  [&](const Triangle& t) { return (mesh.vertices[t[0]] - centre).norm() < 15; });
  const Head head = make_head(mesh, {.crown = Vector3d(0, 0, 115)});
  EXPECT_GT(head.closed_part, 0.015);
  for (const Vector3d& p : head.dome.mesh().vertices)
    EXPECT_LE(std::abs(off_ellipsoid(head.to_mesh * p)), 0.6);
  EXPECT_LE(std::abs(off_ellipsoid(head.to_mesh * head.profile.at(0))), 0.6);
}

TEST(Head, DistancesAreThoseInTheAxesOfTheMesh) {
  const TriangleMesh mesh = head_with_ears();
  const Head head = make_head(mesh, {.crown = Vector3d(5, 10, 114)});
  const MeshDistance given(mesh, Vector3d(0, 0, 40));
  for (double y = -60; y < 70; y += 13) {
    const Vector3d p(0.3 * y, y, 118 - 0.005 * y * y);
    EXPECT_NEAR(head.scan.distance(head.to_mesh.inverse() * p), given.closest(p).distance, 1e-9);
    EXPECT_NEAR(head.dome.closest(head.to_mesh.inverse() * p).distance, given.closest(p).distance, 0.1);
  }
}

/// Every point of an ear that stands out lies under the dome, and no other part of it is lifted.
TEST(Head, KeepsThinEarsInItsDome) {
  const Head head = make_head(testing::head_with_thin_ears(), {});
  EXPECT_EQ(head.closed_part, 0);
  EXPECT_TRUE(head.openings.empty());
  for (const double side : {-1.0, 1.0})
    for (const double rise : {-12.0, 0.0, 12.0}) {
      const Vector3d in_ear(side * (testing::ear_centre.x() + 20), testing::ear_centre.y(), 40 + rise);
      EXPECT_LT(head.dome.closest(head.to_mesh.inverse() * in_ear).distance, 0);
      EXPECT_LT(head.scan.distance(head.to_mesh.inverse() * in_ear), 0);
    }
  EXPECT_LE(off_ellipsoid(head, head.profile, 90), 0.15);
}

TEST(Head, SaysHowWideTheHolesAreThatItsDomeCloses) {
  TriangleMesh mesh = ellipsoid(head_axes, 360, 240);
  const double radius = 15;
  for (const Vector3d& centre : {Vector3d(0, 85, 57), Vector3d(60, 20, 65), Vector3d(0, 98, -60)})
    std::erase_if(mesh.triangles,
                  [&](const Triangle& t) { return (mesh.vertices[t[0]] - centre).norm() < radius; });
  const Head head = make_head(mesh, {});
  ASSERT_EQ(head.openings.size(), 2u);  // the third is below the coverage
  for (const DomeOpening& opening : head.openings) {
    EXPECT_NEAR(opening.width_mm, 2 * radius, 5);
    EXPECT_GT(opening.top_z, -60);
    EXPECT_LT(opening.top_z, 0);
  }
}

TEST(Head, OfALampshadeHasAnInventedTop) {
  const Head head = make_head(testing::lampshade(45), {});
  ASSERT_EQ(head.openings.size(), 1u);
  EXPECT_NEAR(head.openings[0].width_mm, 90, 6);
  EXPECT_GT(head.closed_part, 0.02);
}

TEST(Head, IsTheSameInEveryPoseAndUnit) {
  const TriangleMesh mesh = head_with_ears(90, 60);
  const Head upright = make_head(mesh, {.front = Vector3d::UnitY()});
  struct Turned {
    HeadPose pose;
    std::function<Vector3d(const Vector3d&)> turn;
  };
  const std::vector<Turned> cases = {
      {{LengthUnit::m, Vector3d::UnitY(), -Vector3d::UnitZ(), {}, 90},
       [](const Vector3d& p) -> Vector3d { return Vector3d(p.x(), p.z(), -p.y()) / 1000; }},
      {{LengthUnit::inch, -Vector3d::UnitX(), Vector3d::UnitZ(), {}, 90},
       [](const Vector3d& p) -> Vector3d { return Vector3d(-p.z(), -p.x(), p.y()) / 25.4; }},
      {{LengthUnit::cm, Vector3d::UnitY(), Vector3d::UnitX(), {}, 90},
       [](const Vector3d& p) -> Vector3d { return Vector3d(p.y() + 300, p.z(), p.x()) / 10; }}};
  for (const auto& [pose, turn] : cases) {
    TriangleMesh turned = mesh;
    for (Vector3d& p : turned.vertices) p = turn(p);
    const Head head = make_head(turned, pose);
    EXPECT_NEAR(head.to_mesh.linear().determinant(), 1, 1e-12);
    for (const double s : {-80.0, 0.0, 70.0}) {
      EXPECT_LE((head.profile.at(s) - upright.profile.at(s)).norm(), 1e-6);
      EXPECT_LE((cross_section(head, s, 10).at(50) - cross_section(upright, s, 10).at(50)).norm(), 1e-6);
    }
  }
}

TEST(Head, IsTakenToBeLongerThanBroad) {
  TriangleMesh mesh = ellipsoid({98, 77, 115}, 90, 60);
  EXPECT_EQ(make_head(mesh, {}).to_mesh.linear().col(1), Vector3d::UnitX());
  EXPECT_EQ(make_head(mesh, {.front = -Vector3d::UnitY()}).to_mesh.linear().col(1), -Vector3d::UnitY());
}

std::string says(const TriangleMesh& mesh, const HeadPose& pose, const std::string& key) {
  try {
    make_head(mesh, pose);
  } catch (const InvalidHead& e) {
    EXPECT_EQ(e.key(), key) << e.what();
    return e.what();
  }
  return {};
}

TEST(Head, OfAnotherSizeIsRefusedWithTheUnitThatWouldDo) {
  const auto sized = [](double mm) { return ellipsoid(mm / 230 * head_axes, 24, 12); };
  EXPECT_THAT(says(sized(2), {}, "units"), HasSubstr("is 2 mm long"));
  EXPECT_THAT(says(sized(0.23), {}, "units"), HasSubstr("`units: m` would make it 230 mm"));
  EXPECT_THAT(says(sized(23), {}, "units"), HasSubstr("`units: cm` would make it 230 mm"));
  EXPECT_THAT(says(sized(9), {}, "units"), HasSubstr("`units: in` would make it 228.6 mm"));
  EXPECT_THAT(says(sized(230), {.unit = LengthUnit::m}, "units"),
              HasSubstr("`units: mm` would make it 230 mm"));
  EXPECT_THAT(says(sized(2e6), {}, "units"),
              HasSubstr("is 2e+06 mm long; a head (or a bust) is 100 to 1000 mm"));
}

TEST(Head, RefusesACrownAwayFromTheMesh) {
  const TriangleMesh mesh = head_with_ears(90, 60);
  EXPECT_THAT(says(mesh, {.crown = Vector3d(0, 0, 145)}, "crown"), HasSubstr("is 30 mm from the mesh"));
  EXPECT_THAT(says(mesh, {.crown = Vector3d(0, 0, 0)}, "crown"),
              HasSubstr("leave it out for the highest, [0, 0, 115]"));
  EXPECT_EQ(says(mesh, {.crown = Vector3d(0, 0, 125)}, "crown"), "");
}

TEST(Head, RefusesACoverageThatTheMeshDoesNotReach) {
  const TriangleMesh mesh = ellipsoid(head_axes, 180, 120);
  EXPECT_THAT(says(mesh, {.coverage_mm = 400}, "coverage_mm"),
              HasSubstr("to the back the head can be followed down to"));
  TriangleMesh cap = mesh;
  std::erase_if(cap.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]].z() < 60; });
  EXPECT_THAT(says(cap, {.coverage_mm = 120}, "coverage_mm"), HasSubstr("goes beyond the mesh"));
  EXPECT_EQ(says(cap, {.coverage_mm = 45}, "coverage_mm"), "");
  TriangleMesh open = mesh;
  std::erase_if(open.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]].x() > 20; });
  EXPECT_THAT(says(open, {}, "coverage_mm"), HasSubstr("to the right"));
  std::erase_if(open.triangles, [&](const Triangle& t) { return std::abs(mesh.vertices[t[0]].x()) < 30; });
  EXPECT_THAT(says(open, {.crown = Vector3d(-28, 0, 105)}, "mesh"), HasSubstr("no surface at the crown"));
}

TEST(Head, RefusesAFrontAlongUp) {
  EXPECT_THAT(says(head_with_ears(90, 60), {.front = -Vector3d::UnitZ()}, "front"), HasSubstr("across"));
}

}  // namespace
}  // namespace kinetix::targets
