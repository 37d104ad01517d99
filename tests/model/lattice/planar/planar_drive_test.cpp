#include "model/lattice/planar/planar_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/bad_input.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::model {
namespace {

using ::testing::HasSubstr;
using testing::refusal;

PlanarStructure honeycomb(int columns, int rows) {
  return make_planar_structure({&honeycomb_lattice, lattice_cells(columns, rows)}, {});
}

std::vector<PlanarStructure> panels() {
  return {make_planar_structure({&rhombus_lattice, lattice_cells(4, 3), 1.1}, {}),
          make_planar_structure({&honeycomb_lattice, lattice_cells(3, 3)}, {}),
          make_planar_structure({&honeycomb_lattice, lattice_cells(3, 4), 0, true}, {}),
          make_planar_structure({&brick_lattice, lattice_cells(3, 2)}, {}),
          make_planar_structure({&octagon_lattice, lattice_cells(3, 3), 0, true}, {})};
}

/// Returns a motion that shears every row, and so bends no line across either axis.
Redrawing sheared(const PlanarStructure& s, double by) {
  Redrawing y;
  for (const Eigen::Vector2d& x : s.graph.vertices) y.emplace_back(by * x.x(), -by * x.y());
  return y;
}

TEST(PlanarDrive, GripsTheOutermostLinesOfVertices) {
  const GrippedRows bricks = rim_rows(panels()[3], Axis::y);
  EXPECT_EQ(bricks[0], (std::vector{0, 1, 2, 3, 4, 5, 6})) << "three bricks side by side";
  EXPECT_EQ(bricks[1].size(), 7u);
  for (const PlanarStructure& s : panels()) {
    const Axis axis = drive_to(s, 0.1).axis;
    const int along = axis == Axis::x ? 0 : 1;
    const GrippedRows rows = rim_rows(s, axis);
    for (int side = 0; side < 2; ++side)
      for (int v = 0; v < static_cast<int>(s.graph.vertices.size()); ++v) {
        const double y = s.graph.vertices[v][along], rim = s.graph.vertices[rows[side][0]][along];
        const bool gripped = std::count(rows[side].begin(), rows[side].end(), v) > 0;
        EXPECT_EQ(gripped, std::abs(y - rim) < 1e-6) << "vertex " << v;
        EXPECT_TRUE(side == 0 ? y > rim - 1e-6 : y < rim + 1e-6) << "vertex " << v;
      }
  }
}

TEST(PlanarDrive, IsRefusedWherePlatesTouchOneVertexAlone) {
  const PlanarStructure cell = honeycomb(1, 1);
  EXPECT_THAT(
      refusal([&] { plate_drive(cell, Axis::y, 0.1, 1); }),
      HasSubstr("plates normal to y would touch this panel at vertex 0 alone and let it turn; allowed: "
                "x, or kind: hinge"));
  EXPECT_EQ(refusal([&] { plate_drive(cell, Axis::x, 0.1, 1); }), "");
  const PlanarStructure rhombi = panels()[0];
  EXPECT_THAT(refusal([&] { rim_rows(rhombi, Axis::x); }), HasSubstr("allowed: y, or kind: hinge"));
}

TEST(PlanarDrive, ToAnyThetaIsReadAsThatTheta) {
  for (PlanarStructure& s : panels())
    for (const bool moved : {false, true}) {
      if (moved) place_hinges(sheared(s, 0.2), s);
      const ExactMotion motion = exact_motion(s);
      ASSERT_TRUE(motion) << motion.why;
      for (const double theta : {-1.2, -0.5, -0.05, 0.05, 0.4, 0.9, 1.3})
        EXPECT_NEAR(motion.theta_of(drive_to(s, theta)), theta, 1e-9) << s.drawn.lattice->name;
    }
}

TEST(PlanarDrive, ToThetaOfPlatesClosesThemAsTheMotionDoes) {
  for (const PlanarStructure& s : panels()) {
    const LinkageDrive drive = drive_to(s, 0.6);
    ASSERT_EQ(drive.kind, LinkageDrive::Kind::plates) << s.drawn.lattice->name;
    EXPECT_NEAR(drive.compression, 1 - std::cos(0.6), 1e-12) << "basic hinges shrink the panel evenly";
    EXPECT_EQ(drive.branch, 1);
    EXPECT_EQ(drive_to(s, -0.6).branch, -1);
  }
}

TEST(PlanarDrive, RefusesRowsThatCurveInTheExactMotion) {
  PlanarStructure s = panels()[3];
  Redrawing y = sheared(s, 0);
  y[3].x() += 0.3;
  y[0].y() += 0.3;
  place_hinges(y, s);
  const ExactMotion motion = exact_motion(s);
  ASSERT_TRUE(motion) << motion.why;
  EXPECT_FALSE(keeps_rows_straight(y, Axis::y, rim_rows(s, Axis::y)));
  EXPECT_THAT(
      refusal([&] { motion.theta_of(plate_drive(s, Axis::y, 0.1, 1)); }),
      HasSubstr("plates normal to y would hold rows straight that curve in this panel's exact motion"));
  const LinkageDrive drive = drive_to(s, 0.3);
  EXPECT_EQ(drive.kind, LinkageDrive::Kind::hinge) << "rows across x curve as well";
  EXPECT_NEAR(motion.theta_of(drive), 0.3, 1e-9);
}

// Both halves of a wall turn by theta, against each other.
TEST(PlanarDrive, OfAHingeTurnsItByTwiceTheta) {
  const PlanarStructure s = honeycomb(3, 3);
  const ExactMotion motion = exact_motion(s);
  for (const int hinge : {0, 7, 20})
    for (const double theta : {-0.7, 0.2, 1.1}) {
      const double angle = -2 * s.senses[s.graph.edges[hinge].from] * theta;
      EXPECT_NEAR(motion.theta_of(hinge_drive(s, hinge, angle)), theta, 1e-9) << hinge;
    }
}

TEST(PlanarDrive, RefusesValuesOutOfRange) {
  PlanarStructure s = honeycomb(2, 2);
  EXPECT_THAT(refusal([&] { plate_drive(s, Axis::y, 1, 1); }), HasSubstr("drive.compression"));
  EXPECT_THAT(refusal([&] { plate_drive(s, Axis::y, NAN, 1); }), HasSubstr("drive.compression"));
  EXPECT_THAT(refusal([&] { plate_drive(s, Axis::y, 0.1, 0); }), HasSubstr("drive.branch"));
  EXPECT_THAT(refusal([&] { hinge_drive(s, 0, 3.2); }), HasSubstr("drive.angle"));
  EXPECT_THAT(refusal([&] { drive_to(s, 1.6); }), HasSubstr("theta"));
  s.hinges[2].t = 1.5;
  EXPECT_THAT(refusal([&] { hinge_drive(s, 0, 0.1); }), HasSubstr("t of the hinge on wall [1, 3] is 1.5"));
}

}  // namespace
}  // namespace kinetix::model
