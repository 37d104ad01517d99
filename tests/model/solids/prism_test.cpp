#include "model/solids/prism.hpp"

#include <gtest/gtest.h>
#include <random>

#include "model/base/geometry.hpp"

namespace kinetix::model {
namespace {

/// Expects a closed prism with the volume of the rings.
void expect_prism(const std::vector<FlatRing>& rings) {
  const Polyhedron prism = make_prism(rings, -1, 2);
  double area = 0;
  for (const FlatRing& ring : rings) area += signed_area(ring);
  EXPECT_TRUE(is_closed(prism));
  EXPECT_NEAR(volume_mm3(prism), 3 * area, 1e-9 * area);
}

FlatRing square_ring(double x, double y, double side, bool is_hole) {
  FlatRing ring{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
  if (is_hole) std::reverse(ring.begin(), ring.end());
  return ring;
}

TEST(Prism, HasTheVolumeOfItsRing) {
  expect_prism({square_ring(0, 0, 10, false)});
  expect_prism({FlatRing{{0, 0}, {10, 0}, {10, 10}, {5, 3}, {0, 10}}});                      // a notch
  expect_prism({FlatRing{{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 3}, {3, 3}, {3, 9}, {0, 9}}});  // a U
}

TEST(Prism, LeavesHolesOpen) {
  std::vector<FlatRing> rings{square_ring(0, 0, 40, false)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rings.push_back(square_ring(4 + 12 * i, 4 + 12 * j, 6, true));
  expect_prism(rings);
}

TEST(Prism, FollowsStarsOfAnyShape) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(2, 20);
  for (int count = 5; count < 60; ++count) {
    FlatRing star, hole;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * pi * k / count;
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
      star.push_back(radius(random) * along);
      hole.insert(hole.begin(), 0.9 * along);
    }
    expect_prism({star, hole});
  }
}

}  // namespace
}  // namespace kinetix::model
