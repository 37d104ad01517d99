#include "model/opening/wall_overlaps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/base/angle.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

constexpr double thickness = 0.4;  // cell edges: thick, so that a raster counts much

/// One body with half walls at these angles, rad.
Linkage body_with(const std::vector<double>& angles) {
  Linkage panel;
  panel.size = {10, 10 * thickness, 6};
  panel.bodies.resize(1);
  for (const double angle : angles) {
    Plate& plate = panel.plates.emplace_back();
    plate.edge = {std::cos(angle), std::sin(angle), 0};
  }
  return panel;
}

TEST(WallOverlaps, OfACornerIsASquareOfHalfTheThickness) {
  const WallOverlap corner = wall_overlaps(body_with({pi / 2, 0})).front();
  EXPECT_NEAR(corner.area, thickness * thickness / 4, 1e-15);
  EXPECT_NEAR((corner.middle - Vector2d::Constant(thickness / 4)).norm(), 0, 1e-15);
}

TEST(WallOverlaps, OfAStraightWallIsNothing) {
  const WallOverlap straight = wall_overlaps(body_with({0, pi})).front();
  EXPECT_EQ(straight.area, 0);
  EXPECT_EQ(straight.middle, Vector2d::Zero());
}

/// Returns how many half walls of the body cover a place, cell edges.
long covers_at(const Linkage& panel, const Vector2d& place) {
  return std::count_if(panel.plates.begin(), panel.plates.end(), [&](const Plate& plate) {
    const Vector2d along = plate.edge.head<2>();
    return place.dot(along) > 0 && std::abs(along.x() * place.y() - along.y() * place.x()) < thickness / 2;
  });
}

/// A raster counts the area that more than one half wall covers, each time except the first.
TEST(WallOverlaps, AreWhatARasterCountsTwice) {
  constexpr double pixel = 2e-3, reach = 1;  // cell edges
  const std::vector<std::vector<double>> bodies = {
      {0.3, 1.5}, {0.2, 2.1}, {0.0, 1.2, 3.5}, {0.4, 1.6, 2.9, 4.7}, {0.0, 1.1, 2.2, 3.3, 4.4}};
  for (const std::vector<double>& angles : bodies) {
    const Linkage panel = body_with(angles);
    double area = 0;
    Vector2d sum = Vector2d::Zero();
    for (double x = -reach + pixel / 2; x < reach; x += pixel)
      for (double y = -reach + pixel / 2; y < reach; y += pixel)
        if (const long covers = covers_at(panel, {x, y}); covers > 1) {
          area += pixel * pixel * static_cast<double>(covers - 1);
          sum += pixel * pixel * static_cast<double>(covers - 1) * Vector2d(x, y);
        }
    const WallOverlap found = wall_overlaps(panel).front();
    EXPECT_NEAR(found.area, area, 1e-3) << angles.size();
    EXPECT_NEAR((found.middle - sum / area).norm(), 0, 2e-3) << angles.size();
  }
}

}  // namespace
}  // namespace kinetix::model
