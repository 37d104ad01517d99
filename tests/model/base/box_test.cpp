#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "model/base/box.hpp"

namespace kinetix {
namespace {

using Eigen::Vector3d;

/// Whether the segment from p to q (in the frame of the box) meets the box, by clipping at its three slabs.
bool segment_meets(const OrientedBox& box, const Vector3d& p, const Vector3d& q) {
  double from = 0, to = 1;
  for (int k = 0; k < 3; ++k) {
    const double start = p[k], along = q[k] - p[k];
    if (along == 0 && std::abs(start) > box.half[k]) return false;
    if (along == 0) continue;
    const double a = (-box.half[k] - start) / along, b = (box.half[k] - start) / along;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to;
}

bool an_edge_meets(const OrientedBox& edges, const OrientedBox& box) {
  const auto corner = [&](int bits) {
    Vector3d s;
    for (int k = 0; k < 3; ++k) s[k] = (bits >> k & 1) ? edges.half[k] : -edges.half[k];
    return Vector3d(box.axes.transpose() * (edges.center + edges.axes * s - box.center));
  };
  for (int bits = 0; bits < 8; ++bits)
    for (int k = 0; k < 3; ++k)
      if (!(bits >> k & 1) && segment_meets(box, corner(bits), corner(bits | 1 << k))) return true;
  return false;
}

/// Two convex bodies overlap exactly where an edge of one meets the other.
bool overlap_by_edges(const OrientedBox& a, const OrientedBox& b) {
  return an_edge_meets(a, b) || an_edge_meets(b, a);
}

OrientedBox random_box(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1), size(0.05, 1);
  OrientedBox box;
  box.center = 1.2 * Vector3d(unit(random), unit(random), unit(random));
  box.axes = Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random))
                 .normalized()
                 .toRotationMatrix();
  box.half = {size(random), size(random), size(random)};
  return box;
}

TEST(OrientedBox, OverlapAgreesWithEdgesMeetingBoxes) {
  std::mt19937 random(61);
  int overlapping = 0;
  for (int k = 0; k < 20000; ++k) {
    const OrientedBox a = random_box(random), b = random_box(random);
    const bool expected = overlap_by_edges(a, b);
    overlapping += expected;
    const bool clear = overlap(a, b, 1e-9) == overlap(a, b, -1e-9);
    EXPECT_TRUE(!clear || overlap(a, b) == expected) << "seed 61, pair " << k;
  }
  EXPECT_GT(overlapping, 4000);
  EXPECT_LT(overlapping, 16000);
}

TEST(OrientedBox, OverlapOfNearlyParallelBoxesIsThatOfTheirIntervals) {
  std::mt19937 random(62);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double lean : {0.0, 1e-16, 1e-12, 1e-8, 1e-7, 1e-5})
    for (int k = 0; k < 300; ++k) {
      OrientedBox a, b;
      a.half = b.half = {1, 0.5, 0.1};
      a.axes = random_box(random).axes;
      const Vector3d axis = Vector3d(unit(random), unit(random), unit(random)).normalized();
      b.axes = Eigen::AngleAxisd(lean, axis) * a.axes;
      const Vector3d offset = Vector3d(2.5 * unit(random), 1.5 * unit(random), 0.4 * unit(random));
      b.center = a.axes * offset;
      const double gap = (offset.cwiseAbs() - 2 * a.half).maxCoeff();
      EXPECT_TRUE(std::abs(gap) < 1e-4 || overlap(a, b) == (gap < 0)) << "seed 62, lean " << lean;
    }
}

TEST(OrientedBox, DepthIsTheOverlapThatDoesNotCountYet) {
  OrientedBox a, b;
  a.half = b.half = {1, 1, 1};
  b.center = {1.9, 0, 0};
  EXPECT_TRUE(overlap(a, b, 0.09));
  EXPECT_FALSE(overlap(a, b, 0.11));
  b.center = {2.1, 0, 0};
  EXPECT_TRUE(overlap(a, b, -0.11));
  EXPECT_FALSE(overlap(a, b, -0.09));
}

TEST(OrientedBox, CrossedEdgesAreToldApartByTheirCommonNormalAlone) {
  OrientedBox a, b;
  a.half = b.half = {2, 0.1, 0.1};
  a.axes = Eigen::AngleAxisd(M_PI_4, Vector3d::UnitX()).toRotationMatrix();
  b.axes = Eigen::AngleAxisd(2 * M_PI_4, Vector3d::UnitZ()).toRotationMatrix() * a.axes;
  b.center = {0, 0, 0.2 * std::sqrt(2.0) + 0.001};
  EXPECT_FALSE(overlap(a, b));
  b.center.z() -= 0.002;
  EXPECT_TRUE(overlap(a, b));
}

/// A sphere-like bound from the other side: the distance of any two points of the boxes.
TEST(OrientedBox, SeparationIsPositiveWhereBoxesAreApartAndNeverMoreThanTheirDistance) {
  std::mt19937 random(63);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 300; ++k) {
    const OrientedBox a = random_box(random), b = random_box(random);
    const double gap = separation(a, b);
    EXPECT_EQ(gap > 0, !overlap(a, b)) << "seed 63";
    for (int n = 0; n < 50; ++n) {
      const auto point = [&](const OrientedBox& box) {
        return Vector3d(box.center +
                        box.axes * Vector3d(unit(random), unit(random), unit(random)).cwiseProduct(box.half));
      };
      EXPECT_LE(gap, (point(a) - point(b)).norm() + 1e-12) << "seed 63";
    }
  }
}

OrientedBox random_slanted(std::mt19937& random) {
  OrientedBox box = random_box(random);
  box.slant =
      std::uniform_real_distribution<double>(-1, 1)(random) * std::min(1.0, box.half[0] / box.half[1]);
  return box;
}

std::vector<Vector3d> corners(const OrientedBox& box) {
  std::vector<Vector3d> all;
  for (const double u : {-1.0, 1.0})
    for (const double v : {-1.0, 1.0})
      for (const double w : {-1.0, 1.0}) {
        const double up = v * box.half[1];
        const Vector3d at(u * box.half[0] + (u > 0 ? box.slant * up : 0), up, w * box.half[2]);
        all.push_back(box.center + box.axes * at);
      }
  return all;
}

/// Distance of the hulls of two sets of points, from above: steps towards the corner of their difference that is nearest to
/// the origin (Frank and Wolfe 1956).
double distance_of_hulls(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  std::vector<Vector3d> differences;
  for (const Vector3d& p : a)
    for (const Vector3d& q : b) differences.push_back(p - q);
  Vector3d nearest = differences[0];
  for (int step = 0; step < 4000; ++step) {
    Vector3d best = nearest;
    double least = best.dot(nearest);
    for (const Vector3d& difference : differences)
      if (const double here = difference.dot(nearest); here < least) {
        best = difference;
        least = here;
      }
    const Vector3d way = best - nearest;
    if (!(way.squaredNorm() > 0)) break;
    nearest += std::clamp(-nearest.dot(way) / way.squaredNorm(), 0.0, 1.0) * way;
  }
  return nearest.norm();
}

TEST(SlantedBox, ReachesAsFarAsItsFurthestCorner) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const OrientedBox box = random_slanted(random);
    const Vector3d direction = random_slanted(random).axes.col(0);
    double furthest = -1e300, around = 0;
    for (const Vector3d& corner : corners(box)) {
      furthest = std::max(furthest, (corner - box.center).dot(direction));
      around = std::max(around, (corner - box.center).norm());
    }
    EXPECT_NEAR(support(box, direction), furthest, 1e-14);
    EXPECT_NEAR(radius(box), around, 1e-14);
  }
}

TEST(SlantedBox, OverlapsWhereTheHullsOfTheCornersDo) {
  std::mt19937 random(6);
  int together = 0, apart = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const OrientedBox a = random_slanted(random),
                      b = trial % 3 == 0 ? random_box(random) : random_slanted(random);
    const double distance = distance_of_hulls(corners(a), corners(b));
    if (overlap(a, b, 0.05)) {
      EXPECT_LE(distance, 0.01) << trial;
      ++together;
    } else if (!overlap(a, b)) {
      EXPECT_GE(distance, separation(a, b) - 1e-12) << trial;
      ++apart;
    }
    EXPECT_EQ(overlap(a, b), overlap(b, a)) << trial;
    EXPECT_EQ(separation(a, b) > 0, !overlap(a, b)) << trial;
  }
  EXPECT_GE(together, 50);
  EXPECT_GE(apart, 50);
}

TEST(SlantedBox, OfHardlyAnySlantIsABox) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const OrientedBox a = random_box(random), b = random_box(random);
    OrientedBox slanted = a;
    slanted.slant = 1e-14;
    EXPECT_EQ(overlap(slanted, b), overlap(a, b)) << trial;
    EXPECT_NEAR(separation(slanted, b), separation(a, b), 1e-12) << trial;
  }
}

TEST(OrientedBox, SeparationAcrossAFaceIsTheDistance) {
  OrientedBox a, b;
  a.half = b.half = {1, 2, 3};
  b.center = {2.5, 1, 1};
  EXPECT_DOUBLE_EQ(separation(a, b), 0.5);
}

}  // namespace
}  // namespace kinetix
