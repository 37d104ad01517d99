#include "model/elastic/contact/relative_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double spacing_mm = 8, reach = 0.7, margin = 0.3;  // mm; cell edges

/// Returns bodies on a grid in the plane, one cell edge apart.
State grid(int columns, int rows) {
  State state;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      state.push_back({Eigen::Matrix3d::Identity(), spacing_mm * Vector3d(i, j, 0)});
  return state;
}

Vector3d random_vector(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return {unit(random), unit(random), unit(random)};
}

/// Returns the state compressed, sheared and bent along the columns by `wave` cell edges. Every body is also shaken by
/// `shake` cell edges and rad.
State moved(const State& from, double strain, double wave, double shake, std::mt19937& random) {
  Eigen::Matrix3d gradient;
  for (int column = 0; column < 3; ++column) gradient.col(column) = strain * random_vector(random);
  State to = from;
  for (Pose& pose : to) {
    const double phase = pose.p.x() / spacing_mm / 6;
    pose.p += gradient * pose.p + spacing_mm * (wave * Vector3d(0, std::sin(phase), std::cos(phase)) +
                                                shake / 2 * random_vector(random));
    const Vector3d turn = shake / 2 * random_vector(random);
    pose.R = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()) * pose.R;
  }
  return to;
}

/// Returns how far a point that a body carries has moved, cell edges.
Vector3d way(const Pose& from, const Pose& to, const Vector3d& carried) {
  return (to.p - from.p) / spacing_mm + (to.R - from.R) * carried;
}

/// Returns whether two bodies brought points together that were apart by the margin, from their motion and not from a
/// bound.
bool came_close(const State& from, const State& to, std::size_t a, std::size_t b, std::mt19937& random) {
  if ((from[a].p - from[b].p).norm() / spacing_mm > 2 * reach + margin)
    return (to[a].p - to[b].p).norm() / spacing_mm < 2 * reach;
  const Vector3d on_a = reach * random_vector(random).normalized(),
                 on_b = reach * random_vector(random).normalized();
  return (way(from[a], to[a], on_a) - way(from[b], to[b], on_b)).norm() > margin;
}

TEST(RelativeMotion, NeverSaysThatBodiesKeptApartWhichCameClose) {
  std::mt19937 random(21);
  int kept = 0, close = 0;
  for (int round = 0; round < 300; ++round) {
    const double size = std::pow(10, -2.5 + 2.5 * round / 300);
    const State from = grid(1 + round % 24, 1 + round % 7);
    const State to = moved(from, 0.2 * size, 2 * size, size, random);
    RelativeMotion motion(spacing_mm, reach);
    motion.remember(from);
    const bool keeps = motion.keeps_apart(to, margin);
    kept += keeps;
    bool any = false;
    for (std::size_t a = 0; a < from.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) any = any || came_close(from, to, a, b, random);
    close += any;
    EXPECT_FALSE(keeps && any) << "round " << round;
  }
  EXPECT_GE(kept, 60);
  EXPECT_GE(close, 60);
}

TEST(RelativeMotion, FarPartsOfASheetMayMoveApart) {
  const State from = grid(100, 10);
  State to = from;
  for (Pose& pose : to) pose.p.y() += spacing_mm * std::sin(pose.p.x() / spacing_mm / 60);
  RelativeMotion motion(spacing_mm, reach);
  motion.remember(from);
  EXPECT_TRUE(motion.keeps_apart(to, margin));
  to[500].p.y() += 0.4 * spacing_mm;
  EXPECT_FALSE(motion.keeps_apart(to, margin));
}

/// Two neighbours that turn carry points towards each other by more than the margin, though either alone does not.
TEST(RelativeMotion, CountsHowBothOfTwoBodiesTurn) {
  const State from = grid(100, 10);
  RelativeMotion motion(spacing_mm, reach);
  motion.remember(from);
  const double turn = 0.65 * margin / reach;
  for (const std::size_t first : {std::size_t{0}, from.size() - 2}) {
    State to = from;
    to[first].R = Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
    to[first + 1].R = Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_FALSE(motion.keeps_apart(to, margin)) << first;
  }
}

TEST(RelativeMotion, KnowsNothingOfOtherStructuresAndOfStatesThatAreNotFinite) {
  RelativeMotion motion(spacing_mm, reach);
  EXPECT_FALSE(motion.keeps_apart(grid(2, 2), margin));
  motion.remember(grid(2, 2));
  EXPECT_TRUE(motion.keeps_apart(grid(2, 2), margin));
  EXPECT_FALSE(motion.keeps_apart(grid(3, 2), margin));
  State broken = grid(2, 2);
  broken[1].p.x() = NAN;
  EXPECT_FALSE(motion.keeps_apart(broken, margin));
}

}  // namespace
}  // namespace kinetix::model
