#include "model/lattice/square/unit_laws.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "model/base/invalid_input.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

Structure unit(const CellTuple& tuple) {
  Structure cell = make_structure(rectangle(1, 1), {});
  apply_pattern(cell, tuple, tuple, SharedWalls::must_agree);
  return cell;
}

/// The two sides of the folded first cell, over the cell edge.
struct Sides {
  Vector3d x, y;
};
Sides sides(const CellTuple& tuple, double theta) {
  const Structure cell = unit(tuple);
  const State state = fold(classify(cell), cell, theta);
  const double L = cell.size.edge_mm;
  return {(state[2].p - state[0].p) / L, (state[1].p - state[0].p) / L};
}

TEST(UnitLaws, GrueblersCountOfTheFourBarLinkageIsOne) {
  EXPECT_EQ(gruebler_planar(4, 4, 4), 1);
  EXPECT_EQ(gruebler_spatial(4, 4, 4), -2);
}

TEST(UnitLaws, GrueblersCountOfThePapersGridIsMinusSeven) {
  const Structure grid = make_structure(rectangle(3, 5), {});
  const int bodies = static_cast<int>(grid.bodies.size()), hinges = static_cast<int>(grid.hinges.size());
  EXPECT_EQ(bodies, 24);
  EXPECT_EQ(hinges, 38);
  EXPECT_EQ(gruebler_planar(bodies, hinges, hinges), -7);
}

TEST(UnitLaws, AreaRatioIsThatOfTheFoldedUniformCell) {
  for (const double k : {0.05, 0.2, 0.5, 0.8, 1 - 1e-6})
    for (const double theta : {0.0, 0.3, -0.7, 67.5 * radians_per_degree}) {
      const Sides cell = sides({.P = {k, 1 - k, k, 1 - k}}, theta);
      EXPECT_NEAR(cell.x.cross(cell.y).norm(), area_ratio(k, 2 * theta), 1e-14);
      EXPECT_NEAR(cell.x.dot(cell.y), 0, 1e-14);
    }
}

TEST(UnitLaws, FinalAreaRatioIsTheAreaRatioAt135Degrees) {
  for (const double k : {0.0, 0.2, 0.3, 0.49, 0.8, 1.0})
    EXPECT_NEAR(final_area_ratio(k), area_ratio(k, 135 * radians_per_degree), 1e-15);
  EXPECT_NEAR(final_area_ratio(0.2), 1 - 0.16 * (2 + std::sqrt(2.0)), 1e-15);
}

TEST(UnitLaws, ShearedCellClosesByTwiceTheShearAngle) {
  for (const double k : {0.1, 0.3, 0.7, 0.8}) {
    const Sides cell = sides({.P = {k, k, k, k}}, 45 * radians_per_degree);
    EXPECT_NEAR(std::atan2(cell.x.cross(cell.y).z(), cell.x.dot(cell.y)), 2 * shear_angle(k), 1e-14);
  }
}

TEST(UnitLaws, TwistAngleFollowsEquationSix) {
  EXPECT_NEAR(twist_angle(pi / 2), pi, 1e-15);
  for (const double alpha : {0.2, 0.8, 1.5, 2.0, 3.0}) {
    const double gamma = twist_angle(alpha);
    EXPECT_NEAR(1 / std::tan(gamma / 2), std::sin(pi / 4) / std::tan(alpha), 1e-13);
    EXPECT_NEAR(gamma + twist_angle(pi - alpha), 2 * pi, 1e-14);
  }
}

TEST(UnitLaws, CarriedAxesOfABendUnitKeepEquationEight) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> tilt(-1.2, 1.2), turn(-0.75, 0.75);
  for (const BendUnit variant : {BendUnit::B, BendUnit::C})
    for (int k = 0; k < 20; ++k) {
      const double m = tilt(random), n = tilt(random);
      const Structure cell = unit(bend_unit(variant, m, n));
      const State state = fold(classify(cell), cell, turn(random));
      std::array<Vector3d, 4> axis;
      for (int h = 0; h < 4; ++h)
        axis[h] =
            state[cell.hinges[h].lower].R * hinge_axis(cell.hinges[h].wall.axis, cell.hinges[h].parameters);
      const double u = 0.5 * std::acos(axis[0].dot(axis[2])), v = 0.5 * std::acos(axis[1].dot(axis[3]));
      EXPECT_NEAR(std::cos(u) * std::cos(v), std::cos(m) * std::cos(n), 1e-12) << "seed 41";
      EXPECT_NEAR(mirrored_unit_tilt(m, n, u), v, 1e-6) << "seed 41";
    }
}

TEST(UnitLaws, BendUnitsOfBothSignsAreExactlyMobile) {
  for (const BendUnit variant : {BendUnit::B, BendUnit::C}) {
    const Structure cell = unit(bend_unit(variant, 0.5, 0.8));
    EXPECT_EQ(classify(cell).family, Family::F3);
    EXPECT_LE(hinge_gaps(cell, fold(classify(cell), cell, 0.6)).max, 1e-14);
  }
}

TEST(UnitLaws, CreaseFoldsTheSheetAndItsInverseGivesTheTilt) {
  EXPECT_NEAR(crease_tilt(pi / 2, pi / 4), 54.735610317245346 * radians_per_degree, 1e-15);
  for (const double beta : {-1.2, -0.3, 0.0, 0.7})
    for (const double theta : {-0.7, 0.1, 0.78}) {
      EXPECT_NEAR(crease_tilt(crease_fold(beta, theta), theta), beta, 1e-14);
      auto design = ExactDesign<double>::basic(3, 1);
      design.beta[1] = beta;
      design.theta = theta;
      State poses;
      fold(design, 10.0, poses);
      const Vector3d up = poses[2].R.col(2), after = poses[4].R.col(2);
      EXPECT_NEAR(std::atan2(up.cross(after).norm(), up.dot(after)), std::abs(crease_fold(beta, theta)),
                  1e-14);
    }
}

TEST(UnitLaws, RefuseArgumentsOutsideTheirRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(gruebler_planar(0, 1, 1), InvalidInput);
  EXPECT_THROW(gruebler_spatial(2, -1, 1), InvalidInput);
  for (const double k : {-0.1, 1.1, nan}) EXPECT_THROW(area_ratio(k, 1), InvalidInput);
  EXPECT_THROW(area_ratio(0.5, nan), InvalidInput);
  for (const double k : {-0.1, 0.5, 1.1, nan}) EXPECT_THROW(final_area_ratio(k), InvalidInput);
  for (const double k : {0.0, 0.5, 1.1, nan}) EXPECT_THROW(shear_angle(k), InvalidInput);
  for (const double alpha : {0.0, 4.0, nan}) EXPECT_THROW(twist_angle(alpha), InvalidInput);
  for (const double beta : {-1.6, 1.6, nan}) {
    EXPECT_THROW(bend_unit(BendUnit::B, beta, 0), InvalidInput);
    EXPECT_THROW(bend_unit(BendUnit::C, 0, beta), InvalidInput);
    EXPECT_THROW(crease_fold(beta, 0.1), InvalidInput);
    EXPECT_THROW(mirrored_unit_tilt(beta, 0.1, 0), InvalidInput);
  }
  for (const double u : {1.5, nan}) EXPECT_THROW(mirrored_unit_tilt(0.3, 0.3, u), InvalidInput);
  for (const double theta : {-2.0, 0.0, nan}) EXPECT_THROW(crease_tilt(1, theta), InvalidInput);
  for (const double fold : {-3.2, 3.2, nan}) EXPECT_THROW(crease_tilt(fold, 0.5), InvalidInput);
}

}  // namespace
}  // namespace kinetix::model
