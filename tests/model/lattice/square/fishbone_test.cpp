#include "model/lattice/square/fishbone.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/family/net.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::model {
namespace {

TEST(Fishbone, HasACreaseForEveryFreeRowAndEveryRibCell) {
  const Fishbone spine_and_ribs = make_fishbone({9, {{1, {3, 2}}, {5, {0, 4}}}}, {});
  EXPECT_EQ(spine_and_ribs.structure.cells.size(), 9u + 9u);
  EXPECT_EQ(spine_and_ribs.spine.size(), 7u);
  ASSERT_EQ(spine_and_ribs.ribs.size(), 2u);
  EXPECT_EQ(spine_and_ribs.ribs[0][0].size(), 3u);
  EXPECT_EQ(spine_and_ribs.ribs[1][0].size(), 0u);
  EXPECT_EQ(spine_and_ribs.ribs[1][1].size(), 4u);
}

TEST(Fishbone, IsANetWhateverItsTilts) {
  Fishbone spine_and_ribs = make_fishbone({9, {{1, {3, 2}}, {5, {0, 4}}}}, {});
  double tilt = 0.1;
  const auto bend = [&](const Crease& crease) { set_tilt(spine_and_ribs.structure, crease, tilt += 0.05); };
  for (const Crease& crease : spine_and_ribs.spine) bend(crease);
  for (const auto& sides : spine_and_ribs.ribs)
    for (const auto& side : sides)
      for (const Crease& crease : side) bend(crease);
  const Classification kind = classify(spine_and_ribs.structure);
  ASSERT_EQ(kind.family, Family::F4) << kind.why;
  EXPECT_LE(hinge_gaps(spine_and_ribs.structure, fold(kind, spine_and_ribs.structure, 0.6)).max, 1e-13);
}

TEST(Fishbone, RefusesRibsThatOverlapFlat) {
  EXPECT_THROW(make_fishbone({9, {{1, {3, 2}}, {2, {0, 4}}}}, {}), InvalidInput);
  EXPECT_THROW(make_fishbone({9, {{9, {3, 2}}}}, {}), InvalidInput);
  EXPECT_THROW(make_fishbone({0, {}}, {}), InvalidInput);
}

TEST(RotationVector, RateAgreesWithCentralDifferences) {
  for (const double size : {0.0, 1e-6, 5e-3, 0.7, 3.0}) {
    const Eigen::Vector3d v = size * Eigen::Vector3d(0.6, -0.48, 0.64), arm(1, 2, 3);
    const auto moved = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
      return rotation_of(Eigen::Vector3d(at)) * arm;
    };
    Eigen::Matrix3d analytic;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d omega = rotation_rate(v).col(k), carried = rotation_of(v) * arm;
      analytic.col(k) = omega.cross(carried);
    }
    testing::expect_jacobian(moved, v, analytic);
  }
}

}  // namespace
}  // namespace kinetix::model
