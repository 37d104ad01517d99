#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

// Fractions and rad, all different within a kind, so that a wall in the place of another shows.
constexpr CellTuple odd_numbers{
    .P = {0.1, 0.2, 0.3, 0.4}, .A_in = {1.1, 1.2, 1.3, 1.4}, .A_out = {0.1, 0.2, 0.3, 0.4}};

/// The paper's own reading: corners counter-clockwise, hinge k between corners k and k + 1, its axis turned
/// from the edge of that walk towards the wall, which leans out by A_out.
TEST(CellTuple, HingesStandWhereThePaperPutsThem) {
  Structure s = make_structure({{0, 0}}, {});
  apply_pattern(s, odd_numbers, odd_numbers, SharedWalls::must_agree);
  const Vector3d corners[] = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  for (int k = 0; k < 4; ++k) {
    const Vector3d edge = (corners[(k + 1) % 4] - corners[k]) / 10, up = Vector3d::UnitZ();
    const double a = odd_numbers.A_in[k], b = odd_numbers.A_out[k];
    const Vector3d wall = std::cos(b) * up + std::sin(b) * edge.cross(up);
    const Hinge& hinge = s.hinges[s.cell_members[0].hinges[k]];
    EXPECT_LE((s.hinge_point(hinge) - corners[k] - odd_numbers.P[k] * 10 * edge).norm(), 1e-14);
    const Vector3d axis = hinge_axis(hinge.wall.axis, hinge.parameters);
    EXPECT_LE(axis.cross(std::cos(a) * edge + std::sin(a) * wall).norm(), 1e-15) << "wall " << k;
  }
}

TEST(CellTuple, TopAndLeftWallsRunAgainstOurs) {
  const HingeParameters bottom = odd_numbers.wall(0), top = odd_numbers.wall(2);
  EXPECT_EQ(bottom.t, 0.1);
  EXPECT_EQ(bottom.beta, 0.1);
  EXPECT_DOUBLE_EQ(top.t, 0.7);
  EXPECT_DOUBLE_EQ(top.alpha, pi - 1.3);
  EXPECT_EQ(top.beta, -0.3);
}

/// Eq. 9: every cell of the grid scales by the same factor, to the area of Eq. 3 at 135 deg.
TEST(CellTuple, PapersCrossableGridEndsAtEquationThree) {
  Structure s = make_structure(rectangle(3, 5), {});
  apply_pattern(s, {.P = {0.2, 0.8, 0.2, 0.8}}, {.P = {0.8, 0.2, 0.8, 0.2}}, SharedWalls::must_agree);
  const State state = fold(classify(s), s, 67.5 * radians_per_degree);
  for (const CellHinges& cell : s.cell_members) {
    const Vector3d x = state[cell.bodies[1]].p - state[cell.bodies[0]].p;
    const Vector3d y = state[cell.bodies[3]].p - state[cell.bodies[0]].p;
    EXPECT_NEAR(x.cross(y).norm() / 100, final_area_ratio(0.2), 1e-13);
  }
}

/// Eq. 10: neighbouring cells share their walls, and each shears by Eq. 4.
TEST(CellTuple, PapersUncrossableGridShearsByEquationFour) {
  Structure s = make_structure(rectangle(3, 5), {});
  apply_pattern(s, {.P = {0.3, 0.3, 0.3, 0.3}}, {.P = {0.7, 0.7, 0.7, 0.7}}, SharedWalls::must_agree);
  const State state = fold(classify(s), s, pi / 4);
  for (const CellHinges& cell : s.cell_members) {
    const Vector3d x = state[cell.bodies[1]].p - state[cell.bodies[0]].p;
    const Vector3d y = state[cell.bodies[3]].p - state[cell.bodies[0]].p;
    EXPECT_NEAR(std::atan2(x.cross(y).z(), x.dot(y)), 2 * shear_angle(0.3), 1e-13);
  }
}

TEST(CellTuple, NeighboursThatDisagreeAreNamed) {
  Structure s = make_structure(rectangle(3, 5), {});
  try {
    apply_pattern(s, {.P = {0.2, 0.8, 0.2, 0.8}}, {.P = {0.2, 0.8, 0.2, 0.8}}, SharedWalls::must_agree);
    FAIL() << "accepted";
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find("cells [0, 0] and [0, 1]"), std::string::npos) << e.what();
  }
}

TEST(CellTuple, DisagreementMayBeAveraged) {
  Structure s = make_structure(rectangle(2, 1), {});
  const CellTuple even{.P = {0.5, 0.2, 0.5, 0.5}, .A_out = {0, 0.2, 0, 0}};
  const CellTuple odd{.P = {0.5, 0.5, 0.5, 0.6}, .A_in = {1, 1, 1, 1.0}, .A_out = {0, 0, 0, 0.4}};
  apply_pattern(s, even, odd, SharedWalls::average);
  const HingeParameters shared = s.hinges[*s.hinge_at({{1, 0}, Axis::y})].parameters;
  EXPECT_DOUBLE_EQ(shared.t, (0.2 + 0.4) / 2);
  EXPECT_DOUBLE_EQ(shared.alpha, (pi / 2 + pi - 1) / 2);
  EXPECT_DOUBLE_EQ(shared.beta, (0.2 - 0.4) / 2);
  EXPECT_EQ(s.hinges[*s.hinge_at({{0, 0}, Axis::y})].parameters.t, 0.5);
}

TEST(CellTuple, ParityIsThatOfTheCellInItsLattice) {
  Structure s = make_structure({{1, 0}, {2, 0}}, {});
  CellTuple odd;
  odd.A_out[0] = 0.3;
  apply_pattern(s, {}, odd, SharedWalls::must_agree);
  EXPECT_EQ(s.hinges[*s.hinge_at({{1, 0}, Axis::x})].parameters.beta, 0.3);
  EXPECT_EQ(s.hinges[*s.hinge_at({{2, 0}, Axis::x})].parameters.beta, 0);
}

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
