#include "model/contact/near_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace kinetix::model {
namespace {

std::vector<std::pair<int, int>> all_pairs_within(const Eigen::Matrix3Xd& points, double distance) {
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < points.cols(); ++a)
    for (int b = a + 1; b < points.cols(); ++b)
      if ((points.col(a) - points.col(b)).squaredNorm() < distance * distance) pairs.push_back({a, b});
  return pairs;
}

TEST(NearPairs, AreThoseOfAllPairs) {
  std::mt19937 random(63);
  std::uniform_real_distribution<double> unit(-1, 1);
  NearPairs near;
  for (const Eigen::Vector3d& extent :
       {Eigen::Vector3d(10, 1, 1), {3, 3, 3}, {0, 5, 0.1}, {2, 0, 20}, {0, 0, 0}})
    for (const int count : {0, 1, 2, 300}) {
      Eigen::Matrix3Xd points(3, count);
      for (int k = 0; k < count; ++k)
        points.col(k) = extent.cwiseProduct(Eigen::Vector3d(unit(random), unit(random), unit(random)));
      auto pairs = near.find(points, 0.7);
      std::sort(pairs.begin(), pairs.end());
      EXPECT_EQ(pairs, all_pairs_within(points, 0.7)) << "seed 63, extent " << extent.transpose();
    }
}

TEST(NearPairs, OfALatticeAreItsNeighbours) {
  Eigen::Matrix3Xd points(3, 100);
  for (int k = 0; k < 100; ++k) points.col(k) = Eigen::Vector3d(k % 10, k / 10, 0);
  EXPECT_EQ(NearPairs().find(points, 1.1).size(), 180u);
  EXPECT_EQ(NearPairs().find(points, 1.0).size(), 0u);
}

}  // namespace
}  // namespace kinetix::model
