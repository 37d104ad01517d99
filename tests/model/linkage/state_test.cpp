#include "model/linkage/state.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "model/base/algorithms.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Larger, KeepsNanOnceItHasIt) {
  EXPECT_EQ(larger(1, 2), 2);
  EXPECT_EQ(larger(2, 1), 2);
  EXPECT_TRUE(std::isnan(larger(nan, 1)));
  EXPECT_TRUE(std::isnan(larger(1, nan)));
}

State carried(State state, const Eigen::Matrix3d& turn, const Vector3d& shift) {
  for (Pose& pose : state) pose = {turn * pose.R, turn * pose.p + shift};
  return state;
}

Structure folded_sheet(State& state) {
  std::mt19937 random(91);
  const auto design = testing::random_design(Family::F2, 5, 3, random);
  const Structure s = testing::structure_of(design);
  state = fold(design, s);
  return s;
}

TEST(State, RestClosesAllHinges) {
  const Structure s = make_structure(rectangle(4, 3), {});
  const HingeGaps gaps = hinge_gaps(s, rest_state(s));
  EXPECT_LE(gaps.max, 1e-15);
  EXPECT_EQ(gaps.axis_max, 0);
  EXPECT_GE(gaps.worst_hinge, 0);
}

TEST(State, GapOfAShiftedBodyIsItsShift) {
  const Structure s = make_structure(rectangle(2, 1), {});
  State state = rest_state(s);
  state[0].p += Vector3d(0.3, 0, 0.4);
  const HingeGaps gaps = hinge_gaps(s, state);
  EXPECT_NEAR(gaps.max, 0.05, 1e-15);
  EXPECT_NEAR(gaps.rms, 0.05 * std::sqrt(2.0 / 7.0), 1e-15);
  EXPECT_TRUE(s.hinges[gaps.worst_hinge].lower == 0);
  EXPECT_LE(gaps.axis_max, 1e-15);
}

TEST(State, AxisGapOfATiltedBodyIsItsTurn) {
  const Structure s = make_structure({{0, 0}}, {});
  State state = rest_state(s);
  state[3].R = Eigen::AngleAxisd(0.2, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NEAR(hinge_gaps(s, state).axis_max, 0.2, 1e-15);
}

/// A corner that turns about the upright through the hinge of its leaning wall: that hinge's axes part, and
/// the points of its other one.
TEST(HingeGaps, NameTheHingesOfPointsAndOfAxes) {
  Structure s = make_structure(rectangle(1, 1), {});
  const int leaning = *s.hinge_at({{0, 0}, Axis::x}), upright = *s.hinge_at({{0, 0}, Axis::y});
  s.hinges[leaning].parameters.beta = 0.5;
  State state = rest_state(s);
  Pose& corner = state[*s.body_at({0, 0})];
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d point = s.hinge_point(s.hinges[leaning]);
  corner = {turn, point + turn * (corner.p - point)};
  const HingeGaps gaps = hinge_gaps(s, state);
  EXPECT_EQ(gaps.worst_hinge, upright);
  EXPECT_EQ(gaps.worst_axis, leaning);
}

TEST(State, GapsOfNumbersThatAreNotFiniteAreNotFinite) {
  const Structure s = make_structure(rectangle(3, 1), {});
  for (int b = 0; b < 8; ++b) {
    State state = rest_state(s);
    state[b].p.y() = nan;
    EXPECT_TRUE(std::isnan(hinge_gaps(s, state).max));
    EXPECT_TRUE(std::isnan(hinge_gaps(s, state).rms));
    state = rest_state(s);
    state[b].R(1, 2) = nan;
    EXPECT_TRUE(std::isnan(hinge_gaps(s, state).axis_max));
  }
}

TEST(State, DistanceIgnoresRigidMotion) {
  State state;
  const Structure s = folded_sheet(state);
  const Eigen::Matrix3d turn = Eigen::Quaterniond(0.3, -0.7, 0.2, 0.5).normalized().toRotationMatrix();
  EXPECT_LE(aligned_distance(s, carried(state, turn, {100, -20, 7}), state).max, 1e-13);
}

TEST(State, DistanceSeesAMirrorImage) {
  State state;
  const Structure s = folded_sheet(state);
  State mirrored = state;
  for (Pose& pose : mirrored) pose.p.z() *= -1;
  EXPECT_GT(aligned_distance(s, mirrored, state).rms, 1e-2);
}

TEST(State, DistanceDoesNotScale) {
  const Structure s = make_structure({{0, 0}}, {});
  State twice = rest_state(s);
  for (Pose& pose : twice) pose.p *= 2;
  const StateDistance d = aligned_distance(s, twice, rest_state(s));
  EXPECT_NEAR(d.rms, std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(d.max, std::sqrt(0.5), 1e-14);
}

TEST(State, DistanceOfNumbersThatAreNotFiniteIsNotANumber) {
  const Structure s = make_structure({{0, 0}}, {});
  State broken = rest_state(s);
  broken[2].p.x() = nan;
  EXPECT_TRUE(std::isnan(aligned_distance(s, broken, rest_state(s)).rms));
  EXPECT_TRUE(std::isnan(aligned_distance(s, rest_state(s), broken).max));
}

}  // namespace
}  // namespace kinetix::model
