#include "optim/surface/fit_surface.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "model/base/geometry.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points anywhere(Points points, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> any;
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
  for (Vector3d& p : points) p = turn * p + Vector3d(30, -80, 12);
  return points;
}

/// Returns points of a cone of this half angle about z, from height `low` to `high`, over an angle. Its radius at z = 0 is
/// `radius`. A half angle of 0 is a cylinder.
Points cone(double half_angle, double low, double high, double radius, double over) {
  Points out;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      const double z = low + (high - low) * i / 10, angle = over * (j / 10.0 - 0.5),
                   r = radius + z * std::tan(half_angle);
      out.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  return out;
}

Points on_patch(const targets::SurfacePatch& patch) {
  targets::PointGrid corners{1, 1, {}};
  for (const double y : {-1.0, 1.0})
    for (const double x : {-1.0, 1.0})
      corners.points.emplace_back(x * patch.half.x(), y * patch.half.y(),
                                  patch.height({x * patch.half.x(), y * patch.half.y()}).z);
  return points_below(patch, corners);
}

TEST(BestCone, FindsCylindersConesAndPlanes) {
  unsigned seed = 1;
  for (const double over : {0.5, 1.5, 3.0})
    for (const double half_angle : {0.0, 0.1, 0.5, -0.3})
      EXPECT_LE(rms_from_best_cone(anywhere(cone(half_angle, 0, 60, 70, over), seed++)), 0.07)
          << "half angle " << half_angle << " over " << over;
  Points plane;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) plane.emplace_back(3 * i, 2 * j, 0);
  EXPECT_LE(rms_from_best_cone(anywhere(plane, 9)), 0.01);
}

// z = (x^2 + y^2) / (2 R): what is left of y^2 / (2 R) beside its mean, h^2 / (3 sqrt(5) R) over a square of half side h.
TEST(BestCone, IsOffACapByWhatItCannotBendTheOtherWay) {
  const double width = 100, arc = 40 * radians_per_degree, h = width / 2;
  const double radius = std::sqrt(2.0) * h / std::sin(arc / 2);
  const double rms = rms_from_best_cone(on_patch(targets::cap_patch(width, arc)));
  EXPECT_NEAR(rms, h * h / (3 * std::sqrt(5.0) * radius), 0.08 * rms);
  EXPECT_NEAR(rms / targets::cap_patch(width, arc).diagonal(), 0.0127, 0.001);
}

TEST(BestCone, IsOffASaddleByTheSame) {
  const double width = 100, rise = 0.1, h = width / 2, radius = h / (2 * rise);
  const double rms = rms_from_best_cone(on_patch(targets::saddle_patch(width, rise)));
  EXPECT_NEAR(rms, h * h / (3 * std::sqrt(5.0) * radius), 0.1 * rms);
}

TEST(BestCone, GrowsWithTheSizeOfWhatItMisses) {
  const Points points = on_patch(targets::vase_patch(120, 50, 10, 1));
  Points larger = points;
  for (Vector3d& p : larger) p *= 7;
  const double rms = rms_from_best_cone(points);
  EXPECT_GT(rms, 0.1);
  EXPECT_NEAR(rms_from_best_cone(anywhere(larger, 3)), 7 * rms, 7e-3 * rms);
}

/// Vertices in two layers over a patch, as a folded sheet has them.
SurfaceDesign layered(const targets::SurfacePatch& patch, int facets, double layer) {
  SurfaceDesign out;
  out.mesh.columns = out.mesh.rows = facets;
  out.layer = layer;
  for (int j = 0; j <= facets; ++j)
    for (int i = 0; i <= facets; ++i) {
      const Eigen::Vector2d at(patch.half.x() * (2.0 * i / facets - 1),
                               patch.half.y() * (2.0 * j / facets - 1));
      const targets::Height h = patch.height(at);
      const Vector3d normal = Vector3d(-h.slope.x(), -h.slope.y(), 1).normalized();
      out.vertices.push_back(Vector3d(at.x(), at.y(), h.z) + layer_of(i) * layer * normal);
    }
  return out;
}

// A cone with its tip in the middle is four times nearer to a cap than any cylinder.
TEST(BestCone, HasNoTipOverThePoints) {
  const targets::SurfacePatch cap = targets::cap_patch(100, 40 * radians_per_degree);
  const double usual = rms_from_best_cone(on_patch(cap));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int trial = 0; trial < 5; ++trial) {
    targets::PointGrid grid{8, 8, {}};
    for (int j = 0; j <= 8; ++j)
      for (int i = 0; i <= 8; ++i) {
        const double x = 12.5 * (i - 4) + 3 * part(random), y = 12.5 * (j - 4) + 3 * part(random);
        grid.points.emplace_back(x, y, cap.height({x, y}).z + (i % 2 ? 4 : -4));
      }
    EXPECT_NEAR(rms_from_best_cone(points_below(cap, grid)), usual, 0.15 * usual);
  }
  EXPECT_LE(rms_from_best_cone(cone(0.6, 5, 60, 0.5, 2.5)), 0.07);  // its tip just outside
}

TEST(MiddleOf, AZigzagSheetIsTheSurfaceBetweenItsLayers) {
  for (const targets::SurfacePatch& patch : {targets::cap_patch(100, 0.7), targets::saddle_patch(100, 0.2)}) {
    const targets::PointGrid middle = middle_of(layered(patch, 8, 3));
    EXPECT_EQ(middle.points.size(), 64u);
    for (const Vector3d& p : middle.points) EXPECT_NEAR(closest_surface_point(patch, p).distance, 0, 0.5);
    EXPECT_NEAR(gauss_share(patch, middle).share, 1, 0.06) << patch.name;
  }
}

}  // namespace
}  // namespace kinetix::optim
