#include "model/lattice/square/cell_tuple.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "model/lattice/square/unit_laws.hpp"

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

}  // namespace
}  // namespace kinetix::model
