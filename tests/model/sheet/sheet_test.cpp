#include "model/lattice/lattice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/assembly/assembly.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::model {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal;

Structure squares() {
  std::mt19937 random(3);
  return testing::structure_of(testing::random_design(Family::F2, 4, 3, random));
}

/// Three hexagons in an order that is not that of rows.
PlanarStructure hexagons(bool closed = false) {
  return make_planar_structure({&honeycomb_lattice, {{1, 1}, {0, 0}, {1, 0}, {0, 1}}, 0, closed}, {});
}

void expect_same(const Linkage& a, const Linkage& b) {
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t k = 0; k < a.bodies.size(); ++k) {
    EXPECT_EQ(a.bodies[k].position, b.bodies[k].position);
    EXPECT_EQ(a.bodies[k].sense, b.bodies[k].sense);
  }
  ASSERT_EQ(a.hinges.size(), b.hinges.size());
  for (std::size_t k = 0; k < a.hinges.size(); ++k) {
    EXPECT_EQ(a.hinges[k].axis, b.hinges[k].axis);
    EXPECT_EQ(a.hinges[k].lower_arm, b.hinges[k].lower_arm);
    EXPECT_EQ(a.wall_name(static_cast<int>(k)), b.wall_name(static_cast<int>(k)));
  }
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t k = 0; k < a.cells.size(); ++k) {
    EXPECT_EQ(a.cells[k].bodies, b.cells[k].bodies);
    EXPECT_EQ(a.cells[k].hinges, b.cells[k].hinges);
  }
}

TEST(Lattice, OfSquaresIsTheirStructure) {
  const Structure s = squares();
  const Lattice sheet = s;
  expect_same(sheet, s);
  EXPECT_EQ(lattice_name(sheet), "square");
  EXPECT_EQ(sheet.bodies(), 20);
  EXPECT_EQ(sheet.hinges(), 31);
  EXPECT_EQ(sheet.cells(), 12);
  EXPECT_EQ(sheet.planar(), nullptr);
  for (int b = 0; b < sheet.bodies(); ++b) {
    EXPECT_EQ(body_label(sheet, b), body_label(s, b));
    EXPECT_EQ(sheet.rest_position(b), s.rest_position(b));
  }
  for (int c = 0; c < sheet.cells(); ++c) EXPECT_EQ(cell_label(sheet, c), cell_label(s, c));
  for (int h = 0; h < sheet.hinges(); ++h) EXPECT_EQ(wall_name(sheet, h), to_string(s.hinges[h].wall));
  EXPECT_EQ(body_columns(sheet), body_columns(s));
}

TEST(Lattice, OfAHoneycombHasItsCellsInTheOrderGiven) {
  const Lattice sheet = hexagons();
  EXPECT_EQ(lattice_name(sheet), "honeycomb");
  EXPECT_EQ(sheet.cells(), 4);
  EXPECT_THAT(cell_label(sheet, 0), ElementsAre(1, 1));
  EXPECT_THAT(cell_label(sheet, 3), ElementsAre(0, 1));
  const auto& cells = sheet.planar()->drawn.cells;
  for (int c = 0; c < sheet.cells(); ++c) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero(), expected = Eigen::Vector2d::Zero();
    for (const int b : sheet.cell_bodies(c))
      middle += sheet.rest_position(b).head<2>() / sheet.size().edge_mm;
    for (const auto& corner : honeycomb_lattice.corners(cells[c][0], cells[c][1], 0)) expected += corner;
    EXPECT_LE((middle - expected).norm(), 1e-12) << c;
  }
}

TEST(Lattice, OfAHoneycombCountsVerticesAndNamesWallsByThem) {
  const Lattice sheet = hexagons();
  EXPECT_THAT(body_label(sheet, 5), ElementsAre(5));
  EXPECT_EQ(wall_name(sheet, 0), "[0, 2]");
  for (int h = 0; h < sheet.hinges(); ++h) {
    const HingedWall wall = sheet.wall(h);
    EXPECT_EQ(wall_name(sheet, h),
              "[" + std::to_string(wall.lower) + ", " + std::to_string(wall.upper) + "]");
    EXPECT_NEAR(wall.edge.norm(), 1, 1e-12);
  }
}

TEST(Lattice, LabelsCellsOfAClosedRimByTheirNumber) {
  const Lattice sheet = hexagons(true);
  ASSERT_GT(sheet.cells(), 4);
  EXPECT_THAT(cell_label(sheet, 0), ElementsAre(1, 1));
  EXPECT_THAT(cell_label(sheet, 4), ElementsAre(4));
}

// At these angles the middle of a cell is half a hundredth, where rounding decides which way it goes.
TEST(Lattice, OfRhombiFindsItsCellsAtAnyAngle) {
  for (const double cosine : {0.25, 0.125, -0.25, 0.71, 0.0625, 0.33, 0.01, 0.03})
    for (const int n : {3, 7}) {
      const auto cells = lattice_cells(n, n);
      const PlanarStructure s = make_planar_structure({&rhombus_lattice, cells, std::acos(cosine)}, {});
      for (std::size_t c = 0; c < cells.size(); ++c) {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero(), expected = Eigen::Vector2d::Zero();
        for (const int b : s.faces[c].vertices) middle += s.graph.vertices[b];
        for (const auto& corner : rhombus_lattice.corners(cells[c][0], cells[c][1], std::acos(cosine)))
          expected += corner;
        EXPECT_LE((middle - expected).norm(), 1e-12) << cosine << " cell " << c;
      }
    }
}

TEST(Lattice, OfADrawingIsAGraphWhoseCellsAreNumbered) {
  const Lattice sheet = make_planar_structure(testing::random_quads(2, 1), {});
  EXPECT_EQ(lattice_name(sheet), "graph");
  EXPECT_THAT(cell_label(sheet, 3), ElementsAre(3));
}

TEST(Lattice, CountsWhatItsLinkageHas) {
  for (const Lattice& sheet :
       {Lattice(squares()), Lattice(hexagons()), Lattice(make_sodalite({1, 1, 1}, 0.2, {}))}) {
    const Linkage linkage = sheet;
    EXPECT_EQ(sheet.bodies(), static_cast<int>(linkage.bodies.size()));
    EXPECT_EQ(sheet.hinges(), static_cast<int>(linkage.hinges.size()));
    EXPECT_EQ(sheet.cells(), static_cast<int>(linkage.cells.size()));
  }
}

TEST(Lattice, LetsItsHingesBeChanged) {
  for (Lattice sheet : {Lattice(squares()), Lattice(hexagons())}) {
    sheet.hinge(3) = {.t = 0.25, .alpha = 1.5, .beta = 0.25, .offset = 0.125};
    const HingedWall wall = sheet.wall(3);
    EXPECT_EQ(wall.hinge.t, 0.25);
    EXPECT_EQ(wall.hinge.offset, 0.125);
    EXPECT_EQ(std::as_const(sheet).hinge(3).beta, 0.25);
    const Linkage linkage = sheet;
    EXPECT_EQ(linkage.hinges[3].axis, rest_hinge(wall).axis);
    sheet.hinge(3).t = 1.25;
    EXPECT_THAT(refusal([&] { validate_hinges(sheet); }), HasSubstr(wall_name(sheet, 3)));
  }
}

TEST(Lattice, ColumnsGoFromTheLeftAndEachFromBelow) {
  for (const Lattice& sheet :
       {Lattice(squares()), Lattice(hexagons()),
        Lattice(make_planar_structure({&octagon_lattice, lattice_cells(9, 9)}, {})),
        Lattice(make_planar_structure({&honeycomb_lattice, lattice_cells(20, 20)}, {}))}) {
    const auto columns = body_columns(sheet);
    int bodies = 0;
    double left = -INFINITY;
    for (const auto& column : columns) {
      const double x = sheet.rest_position(column[0]).x();
      EXPECT_GT(x, left + 1e-3) << "columns are apart";
      left = x;
      double y = -INFINITY;
      for (const int b : column) {
        EXPECT_NEAR(sheet.rest_position(b).x(), x, 1e-9);
        EXPECT_GT(sheet.rest_position(b).y(), y);
        y = sheet.rest_position(b).y();
        ++bodies;
      }
    }
    EXPECT_EQ(bodies, sheet.bodies());
  }
}

TEST(SheetMotion, DrivesEveryLatticeByItsOwnRules) {
  const Structure s = squares();
  EXPECT_EQ(drive_to(Lattice(s), 0.3).compression, drive_on(s, drive_to(s, 0.3)).compression);
  EXPECT_EQ(exact_motion(Lattice(s)).name, "F2");
  const Lattice sheet = hexagons();
  EXPECT_EQ(exact_motion(sheet).name, "planar");
  for (const double theta : {-0.4, 0.4})
    EXPECT_NEAR(exact_motion(sheet).theta_of(drive_to(sheet, theta)), theta, 1e-9);
  const LinkageDrive turned = drive_on(sheet, HingeTurn{2, 0.5});
  EXPECT_EQ(turned.hinge, 2);
  EXPECT_EQ(turned.angle, 0.5);
}

TEST(SheetMotion, ChangesHingesFromTheFirstSheetToTheSecond) {
  Lattice before = hexagons(), after = hexagons();
  after.hinge(2).t = 0.75;
  const auto at = changing(before, after, drive_to(before, 0.2));
  const auto arm = [](const Linkage& linkage) { return linkage.hinges[2].lower_arm; };
  EXPECT_EQ(arm(at(0).linkage), arm(before));
  EXPECT_EQ(arm(at(1).linkage), arm(after));
  EXPECT_LE((arm(at(0.5).linkage) - (arm(before) + arm(after)) / 2).norm(), 1e-15);
  EXPECT_TRUE(at(0).exact);
  EXPECT_FALSE(at(1).exact) << "one hinge off the middle keeps its cell from closing";
}

TEST(Lattice, HoldsImportedBodiesThatTurnAHingeOfTheirs) {
  const Lattice sheet(make_assembly({{"left", false, testing::box_solid(-9, -0.5, 0.8, 6)},
                                     {"right", false, testing::box_solid(0.5, 9, 0.8, 6)},
                                     {"joint", true, testing::box_solid(-0.5, 0.5, 0.8, 6)}}));
  EXPECT_EQ(sheet.bodies(), 2);
  EXPECT_EQ(sheet.hinges(), 1);
  EXPECT_EQ(sheet.cells(), 0);
  EXPECT_EQ(lattice_name(sheet), "bodies");
  EXPECT_EQ(wall_name(sheet, 0), "`joint`");
  EXPECT_EQ(sheet.wall(0).upper, 1);
  EXPECT_NEAR(sheet.rest_position(1).x(), 4.75, 1e-9);
  expect_same(sheet, linkage_of(*sheet.assembly()));
  EXPECT_FALSE(exact_motion(sheet));
  const LinkageDrive drive = drive_to(sheet, 0.3);
  EXPECT_EQ(drive.kind, LinkageDrive::Kind::hinge);
  EXPECT_EQ(drive.hinge, 0);
  EXPECT_DOUBLE_EQ(drive.theta(), 0.3);
  EXPECT_THAT(refusal([&] { planar_structure(sheet); }), HasSubstr("no planar sheet"));
}

}  // namespace
}  // namespace kinetix::model
