#include "model/assembly/bearing_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/assembly/assembly.hpp"
#include "model/base/geometry.hpp"
#include "model/solids/polyhedron.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::model {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::moved;

constexpr int sides = 24;  // of a circle: facets bend by 15 degrees

/// Returns the solid that a profile (radius, height) makes about z. Its first and last points are on the axis.
Polyhedron turned(const std::vector<Vector2d>& profile) {
  Polyhedron out;
  std::vector<int> first;  // point of each place of the profile
  for (const Vector2d& p : profile) {
    first.push_back(static_cast<int>(out.points.size()));
    for (int k = 0; k < (p.x() > 0 ? sides : 1); ++k) {
      const double a = 2 * pi * k / sides;
      out.points.emplace_back(p.x() * std::cos(a), p.x() * std::sin(a), p.y());
    }
  }
  const auto at = [&](std::size_t k, int side) { return first[k] + (profile[k].x() > 0 ? side % sides : 0); };
  for (std::size_t k = 0; k + 1 < profile.size(); ++k)
    for (int side = 0; side < sides; ++side) {
      const int a = at(k, side), b = at(k, side + 1), c = at(k + 1, side + 1), d = at(k + 1, side);
      if (a != b) out.triangles.push_back({a, b, c == d ? d : c});
      if (c != d) out.triangles.push_back({a, c, d});
    }
  if (volume_mm3(out) < 0)
    for (auto& t : out.triangles) std::swap(t[1], t[2]);
  return out;
}

/// Returns points of a circle about the origin, from one angle off z to another, degrees.
std::vector<Vector2d> arc(double radius, int from_deg, int to_deg) {
  std::vector<Vector2d> out;
  for (int deg = from_deg; deg <= to_deg; deg += 15)
    out.emplace_back(deg == 0 ? 0 : radius * std::sin(deg * pi / 180), radius * std::cos(deg * pi / 180));
  return out;
}

Polyhedron two_tips() { return turned({{0, -5}, {2.5, -2.5}, {2.5, 2.5}, {0, 5}}); }

/// A cup for the upper tip, 0.3 mm away from it, or for the lower one.
Polyhedron cup(bool lower) {
  const double apex = 5 + 0.3 * std::numbers::sqrt2;
  const Polyhedron upper = turned({{0, apex}, {apex - 2.7, 2.7}, {4, 2.7}, {4, 7}, {0, 7}});
  return lower ? moved(upper, Isometry3d(Eigen::AngleAxisd(pi, Vector3d::UnitX()))) : upper;
}

Polyhedron ball_on_stick() {
  std::vector<Vector2d> profile = arc(3, 0, 150);
  profile.insert(profile.end(), {{1.5, -9}, {0, -9}});
  return turned(profile);
}

/// @param last_deg how far the socket goes round its ball
Polyhedron socket(int last_deg) {
  std::vector<Vector2d> profile = arc(3.3, 0, last_deg);
  profile.insert(profile.end(), {{5, profile.back().y()}, {5, 6}, {0, 6}});
  return turned(profile);
}

TEST(BearingFaces, FindTipsAndCups) {
  const std::vector<ConeFace> tips = bearings_of(two_tips()).cones;
  ASSERT_EQ(tips.size(), 2u);
  for (const ConeFace& tip : tips) {
    EXPECT_FALSE(tip.hollow);
    EXPECT_NEAR(tip.slope, 1, 1e-9);
    EXPECT_NEAR((tip.apex - Vector3d(0, 0, -5 * tip.axis.z())).norm(), 0, 1e-9);
  }
  const std::vector<ConeFace> cups = bearings_of(cup(false)).cones;
  ASSERT_EQ(cups.size(), 1u);
  EXPECT_TRUE(cups[0].hollow);
  EXPECT_NEAR(cups[0].axis.z(), -1, 1e-9);
  EXPECT_TRUE(bearings_of(two_tips()).balls.empty());
  EXPECT_TRUE(bearings_of(cup(false)).balls.empty()) << "the rings of a cone are on a sphere, too";
}

TEST(BearingFaces, FindBallsAndSockets) {
  const std::vector<BallFace> balls = bearings_of(ball_on_stick()).balls;
  ASSERT_EQ(balls.size(), 1u);
  EXPECT_FALSE(balls[0].hollow);
  EXPECT_NEAR(balls[0].radius_mm, 3, 1e-9);
  EXPECT_NEAR(balls[0].center.norm(), 0, 1e-9);
  const std::vector<BallFace> sockets = bearings_of(socket(120)).balls;
  ASSERT_EQ(sockets.size(), 1u);
  EXPECT_TRUE(sockets[0].hollow);
  EXPECT_NEAR(sockets[0].reach, 120 * radians_per_degree, 1e-6);
  EXPECT_TRUE(bearings_of(ball_on_stick()).cones.empty());
}

TEST(BearingFaces, TipsInCupsArePinsOfAnAssembly) {
  const Isometry3d motion =
      Eigen::Translation3d(3, -20, 7) * Eigen::AngleAxisd(1.1, Vector3d(1, 2, -0.5).normalized());
  const Assembly found = make_assembly({{"tips", false, moved(two_tips(), motion)},
                                        {"upper", false, moved(cup(false), motion)},
                                        {"lower", false, moved(cup(true), motion)}});
  ASSERT_EQ(found.hinges.size(), 2u);
  for (const AssemblyHinge& hinge : found.hinges) {
    EXPECT_EQ(hinge.kind, HingeKind::pin);
    EXPECT_FALSE(hinge.ball);
    const Vector3d z = motion.linear().col(2);
    EXPECT_NEAR(std::abs(hinge.axis.dot(z)), 1, 1e-9);
    EXPECT_NEAR(z.cross(hinge.point - motion.translation()).norm(), 0, 1e-6);
    EXPECT_NEAR(hinge.clearance_mm, 0.29, 0.02) << "0.3 mm less the height of the cup's facets";
  }
}

TEST(BearingFaces, ABallThatItsSocketRetainsIsASphericalJoint) {
  const Assembly found = make_assembly({{"stick", false, ball_on_stick()}, {"socket", false, socket(120)}});
  ASSERT_EQ(found.hinges.size(), 1u);
  EXPECT_TRUE(found.hinges[0].ball);
  EXPECT_NEAR(found.hinges[0].point.norm(), 0, 1e-9);
  EXPECT_THROW(make_assembly({{"stick", false, ball_on_stick()}, {"socket", false, socket(75)}}), NoHinges);
}

TEST(BearingFaces, TwoBallsArePinAboutTheLineThroughThem) {
  const PinFit pin = pin_of_balls({{1, 0, 0}, 4, 0.2, false}, {{1, 0, 12}, 3, 0.3, false});
  EXPECT_NEAR((pin.point - Vector3d(1, 0, 6)).norm(), 0, 1e-12);
  EXPECT_NEAR(pin.axis.z(), 1, 1e-12);
  EXPECT_EQ(pin.rod_mm, 3);
  EXPECT_EQ(pin.clearance_mm, 0.2);
}

}  // namespace
}  // namespace kinetix::model
