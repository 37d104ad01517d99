#include "targets/space_curve/space_goal.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> helix(double radius, double pitch) {
  std::vector<Vector3d> points;
  for (int k = 0; k <= 200; ++k) {
    const double a = 4 * std::numbers::pi * k / 200;
    points.emplace_back(radius * std::cos(a), radius * std::sin(a), pitch * a / (2 * std::numbers::pi));
  }
  return points;
}

int point_at_fault(const std::vector<Vector3d>& points) {
  try {
    const SpaceGoal goal(points);
  } catch (const InvalidCurve& e) {
    return e.point();
  }
  return -2;
}

TEST(SpaceGoal, CurvesThatAStripCannotTakeAreRefusedAtTheirPoint) {
  EXPECT_EQ(point_at_fault({{0, 0, 0}, {1, 0, 0}}), -1);
  EXPECT_EQ(point_at_fault({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}}), 2);
  EXPECT_EQ(point_at_fault({{0, 0, 0}, {1, 0, 0}, {1, NAN, 0}}), 2);
  EXPECT_EQ(point_at_fault({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}), 3);
  EXPECT_EQ(point_at_fault({{0, 0, 0}, {2, 0, 0}, {1, 0.01, 0}, {0, 5, 0}}), 1);
  EXPECT_EQ(point_at_fault({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {1, -1, 0}}), 3);
}

TEST(SpaceGoal, CurvesThatPassThemselvesAtADistanceAreFine) {
  EXPECT_EQ(point_at_fault({{0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {1, 2, 1}, {1, -1, 1}}), -2);
  EXPECT_EQ(point_at_fault(helix(40, 5)), -2);
}

TEST(SpaceGoal, SegmentDistanceIsThatOfTheirNearestPoints) {
  EXPECT_NEAR(segment_distance({0, 0, 0}, {2, 0, 0}, {1, -1, 3}, {1, 1, 3}), 3, 1e-15);
  EXPECT_NEAR(segment_distance({0, 0, 0}, {1, 0, 0}, {4, 4, 0}, {4, 5, 0}), 5, 1e-15);
  EXPECT_NEAR(segment_distance({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}), 1, 1e-15);
}

TEST(SpaceError, AGoalThatWasMovedIsBroughtBackOntoItself) {
  const SpaceGoal goal(helix(40, 40));
  const model::Pose place{Eigen::AngleAxisd(0.1, Vector3d(1, 2, -1).normalized()).toRotationMatrix(),
                          {3, -2, 1}};
  const SpaceError error = space_error(goal.points(), goal, place);
  EXPECT_TRUE(error.settled);
  EXPECT_LE(error.rms, 1e-9);
  EXPECT_LE((error.goal_mm[57] - goal.points()[57]).norm(), 1e-6);
}

// A straight midline beside a straight goal, longer by 1 mm at each end, has nothing but its ends to be off by.
TEST(SpaceError, StraightLinesOfDifferentLengthDifferAtTheirEndsAlone) {
  std::vector<Vector3d> short_one, long_one;
  for (int k = 0; k <= 10; ++k) {
    short_one.emplace_back(k, 0, 0);
    long_one.emplace_back(1.2 * k - 1, 0, 0);
  }
  const SpaceError error =
      space_error(long_one, SpaceGoal(short_one), {Eigen::Matrix3d::Identity(), {0, 0.1, 0}});
  EXPECT_NEAR(error.max, 0.1, 1e-6);
}

// A straight midline along a goal that is bent at its middle, both 20 long: whatever the goal's ends stick out by, no small motion
// brings it nearer. Ends have no place to slide to, so that all of their distance counts.
TEST(SpaceError, NoSmallMotionBringsTheGoalNearer) {
  std::vector<Vector3d> bent, straight;
  for (int k = -10; k <= 10; ++k) {
    bent.emplace_back(k, 0, 0.5 * std::abs(k));
    straight.emplace_back(0.9 * k + 1, 0.05 * k, 0);
  }
  const SpaceGoal goal(bent);
  const SpaceError best = space_error(straight, goal, {});
  EXPECT_TRUE(best.settled);
  const auto rms_of = [&](const std::vector<Vector3d>& placed) {
    const targets::SpaceCurve line(straight), moved(placed);
    double sum = 0;
    const auto add = [&](const SpaceCurve& from, const SpaceCurve& to) {
      for (const Vector3d& p : from.evenly(401)) sum += (p - to.at(to.nearest(p))).squaredNorm();
    };
    add(line, moved);
    add(moved, line);
    return std::sqrt(sum / 802) / best.scale_mm;
  };
  const double least = rms_of(best.goal_mm);
  EXPECT_NEAR(least, best.rms, 1e-12);
  const Eigen::Vector3d middle = best.goal_mm[10];
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {-0.02, 0.02}) {
      std::vector<Vector3d> shifted = best.goal_mm, turned = best.goal_mm;
      for (Vector3d& p : shifted) p[axis] += way;
      const Eigen::AngleAxisd turn(way / 10, Vector3d::Unit(axis));
      for (Vector3d& p : turned) p = middle + turn * (p - middle);
      EXPECT_GT(rms_of(shifted), least - 1e-12) << axis << ' ' << way;
      EXPECT_GT(rms_of(turned), least - 1e-12) << axis << ' ' << way;
    }
}

TEST(SpaceError, MidlinesThatAreNotFiniteHaveNone) {
  const SpaceGoal goal(helix(40, 40));
  EXPECT_TRUE(std::isnan(space_error({{0, 0, 0}, {NAN, 0, 0}}, goal, {}).rms));
}

}  // namespace
}  // namespace kinetix::targets
