#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <limits>
#include <set>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "model/hinge/crease_law.hpp"
#include "model/lattice/square/cell_rectangle.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::model {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refusal(std::vector<Cell> cells, const CellSize& size = {}) {
  try {
    make_structure(std::move(cells), size);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Structure, StripOrdersBodiesAndHingesAsTheFileFormatSays) {
  const Structure s = make_structure(rectangle(6, 1), {});
  EXPECT_THAT(s.cell_members[0].bodies, ElementsAre(0, 2, 3, 1));
  EXPECT_THAT(s.cell_members[0].hinges, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(s.cell_members[1].bodies, ElementsAre(2, 4, 5, 3));
  EXPECT_THAT(s.cell_members[1].hinges, ElementsAre(4, 5, 6, 1));
  EXPECT_EQ(s.hinges[0].lower, 0);
  EXPECT_EQ(s.hinges[0].upper, 2);
}

TEST(Structure, RectangleHasOneBodyAVertexAndOneHingeAWall) {
  const Structure s = make_structure(rectangle(7, 4), {});
  EXPECT_EQ(s.cells.size(), 28u);
  EXPECT_EQ(s.bodies.size(), 8u * 5u);
  EXPECT_EQ(s.hinges.size(), 7u * 5u + 8u * 4u);
}

TEST(Structure, SheetIsTheStructureOfARectangle) {
  const Structure a = make_sheet(4, 3, {20, 1, 5}), b = make_structure(rectangle(4, 3), {20, 1, 5});
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.bodies, b.bodies);
  EXPECT_EQ(a.size.edge_mm, 20);
}

TEST(Structure, LabelsBodiesAndCellsByColumnAndRow) {
  const Structure s = make_structure({{1, 0}, {1, 1}, {2, 1}}, {});
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    EXPECT_THAT(body_label(s, b), ElementsAre(s.bodies[b].i, s.bodies[b].j));
  EXPECT_THAT(cell_label(s, 0), ElementsAre(1, 0));
  EXPECT_THAT(cell_label(s, 2), ElementsAre(2, 1));
  EXPECT_EQ(rest_place({2, 1}), Eigen::Vector3d(2, 1, 0));
}

TEST(Structure, DoesNotDependOnTheOrderOfItsCells) {
  const Structure a = make_structure({{0, 0}, {1, 0}, {1, 1}}, {}),
                  b = make_structure({{1, 1}, {0, 0}, {1, 0}}, {});
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.bodies, b.bodies);
  for (std::size_t k = 0; k < a.hinges.size(); ++k) EXPECT_EQ(a.hinges[k].wall, b.hinges[k].wall);
}

TEST(Structure, FindsEveryBodyAndHingeAndNoOther) {
  const Structure s = make_structure({{1, 0}, {1, 1}, {2, 1}, {4, 2}, {3, 1}}, {});
  std::set<Wall> walls;
  for (std::size_t k = 0; k < s.hinges.size(); ++k) {
    const Hinge& h = s.hinges[k];
    EXPECT_EQ(s.hinge_at(h.wall), static_cast<int>(k));
    EXPECT_EQ(s.body_at(h.wall.from), h.lower);
    EXPECT_EQ(s.body_at(h.wall.to()), h.upper);
    EXPECT_TRUE(walls.insert(h.wall).second);
  }
  const std::set<Vertex> vertices(s.bodies.begin(), s.bodies.end());
  for (int i = -2; i < 8; ++i)
    for (int j = -2; j < 6; ++j) {
      EXPECT_EQ(s.body_at({i, j}).has_value(), vertices.contains({i, j}));
      for (const Axis axis : {Axis::x, Axis::y})
        EXPECT_EQ(s.hinge_at({{i, j}, axis}).has_value(), walls.contains({{i, j}, axis}));
    }
}

TEST(Structure, CellMembersStandOnTheirCorners) {
  const Structure s = make_structure({{0, 0}, {1, 0}, {1, 1}}, {});
  for (std::size_t c = 0; c < s.cells.size(); ++c) {
    const auto [i, j] = s.cells[c];
    const Vertex corners[] = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}};
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(s.bodies[s.cell_members[c].bodies[k]], corners[k]);
      const Hinge& h = s.hinges[s.cell_members[c].hinges[k]];
      const std::set<Vertex> ends = {h.wall.from, h.wall.to()};
      EXPECT_EQ(ends, (std::set<Vertex>{corners[k], corners[(k + 1) % 4]}));
    }
  }
}

TEST(Structure, HingePointAndAxisFollowTheirParameters) {
  Structure s = make_structure({{2, 1}}, {8.0, 0.8, 6.0});
  Hinge& bottom = s.hinges[0];
  bottom.parameters = {0.25, 60 * radians_per_degree, 30 * radians_per_degree};
  EXPECT_LE((s.hinge_point(bottom) - Eigen::Vector3d(18, 8, 0)).norm(), 1e-15);
  const double h = std::sqrt(3.0) / 2;
  EXPECT_LE((hinge_axis(Axis::x, bottom.parameters) - Eigen::Vector3d(0.5, -h / 2, h * h)).norm(), 1e-15);
  EXPECT_LE((hinge_axis(Axis::y, bottom.parameters) - Eigen::Vector3d(h / 2, 0.5, h * h)).norm(), 1e-15);
  EXPECT_LE((hinge_axis(Axis::x, {}) - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(Structure, RefusesSizesOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double edge : {0.0, -1.0, nan, inf})
    EXPECT_THAT(refusal({{0, 0}}, {edge, 0.1, 1}), HasSubstr("edge"));
  for (const double wall : {0.0, -1.0, 5.0, nan, inf})
    EXPECT_THAT(refusal({{0, 0}}, {10, wall, 6}), HasSubstr("thickness"));
  for (const double height : {0.0, -1.0, nan, inf})
    EXPECT_THAT(refusal({{0, 0}}, {10, 0.8, height}), HasSubstr("height"));
  EXPECT_EQ(refusal({{0, 0}}, {10, 4.999, 6}), "accepted");
}

TEST(Structure, RefusesCellSetsThatAreEmptyRepeatedOrInPieces) {
  EXPECT_THAT(refusal({}), HasSubstr("at least one cell"));
  EXPECT_THAT(refusal({{0, 0}, {1, 0}, {0, 0}}), HasSubstr("[0, 0] is given twice"));
  EXPECT_THAT(refusal({{0, 0}, {2, 0}}), HasSubstr("[2, 0] does not hang together"));
  EXPECT_EQ(refusal({{0, 0}, {1, 1}}), "accepted");
}

TEST(Structure, RefusesNegativeCells) {
  EXPECT_THAT(refusal({{0, 0}, {-1, 0}}), HasSubstr("[-1, 0] has a negative index"));
  EXPECT_THAT(refusal({{0, 0}, {0, -3}}), HasSubstr("[0, -3] has a negative index"));
  EXPECT_THAT(refusal({{std::numeric_limits<int>::min(), 0}}), HasSubstr("negative"));
}

TEST(Structure, RefusesALatticeOfMoreThanFourMillionVertices) {
  const int far = std::numeric_limits<int>::max();
  EXPECT_THAT(refusal({{1999, 1999}}), HasSubstr("4 million vertices"));
  EXPECT_EQ(refusal({{1998, 1998}}), "accepted");
  EXPECT_THAT(refusal({{far, far}}), HasSubstr("4 million vertices"));
  EXPECT_THAT(refusal({{0, far}}), HasSubstr("4 million vertices"));
  EXPECT_THAT(refusal({{3'999'998, 0}}), HasSubstr("4 million vertices"));
}

TEST(Structure, NamesVerticesCellsAndWallsAsFilesDo) {
  EXPECT_EQ(to_string(Vertex{3, 4}), "[3, 4]");
  EXPECT_EQ(to_string(Cell{0, 7}), "[0, 7]");
  EXPECT_EQ(to_string(Wall{{1, 2}, Axis::y}), "[[1, 2], [1, 3]]");
}

TEST(Structure, VerticalHingesAreThoseWhoseAxisStandsUpToRounding) {
  Hinge hinge;
  EXPECT_TRUE(is_vertical(hinge));
  hinge.parameters = {0.3, pi / 2 + 1e-10, -1e-10};
  EXPECT_TRUE(is_vertical(hinge));
  for (const HingeParameters& p : {HingeParameters{0.5, pi / 2 + 1e-6, 0}, {0.5, pi / 2, 1e-6}}) {
    hinge.parameters = p;
    EXPECT_FALSE(is_vertical(hinge));
  }
}

TEST(Numbering, IsThatOfASheetsBodies) {
  const int columns = 5, rows = 3;
  const Structure sheet = make_sheet(columns, rows, {});
  EXPECT_EQ(lattice_bodies(columns, rows), sheet.bodies.size());
  EXPECT_EQ(vertex_columns(sheet.bodies.size(), rows), columns + 1);
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) EXPECT_EQ(lattice_body({i, j}, rows), sheet.body_at({i, j}));
  for (int i = 0; i <= columns; ++i) EXPECT_EQ(column_sign(i), (Vertex{i, 0}.sense()));
}

TEST(Numbering, LinesOfARectangleEndOnItsRim) {
  const Structure sheet = make_sheet(5, 4, {});
  const CellRectangle part{{1, 1}, 3, 2};
  const std::vector<int> bodies = bodies_of(part, sheet);
  for (const Axis axis : {Axis::x, Axis::y}) {
    const auto ends = line_ends(part, axis);
    EXPECT_EQ(static_cast<int>(ends.size()), (axis == Axis::x ? part.height : part.width) + 1);
    for (const auto& [first, last] : ends) {
      EXPECT_EQ(row_along(axis, sheet.bodies[bodies[first]]), 1);
      EXPECT_EQ(row_along(axis, sheet.bodies[bodies[last]]), 1 + part.extent(axis));
    }
  }
}

TEST(CreaseLaw, IsSolvedForTiltAndForTheta) {
  for (const double turn : {0.2, 1.0, 1.5})
    for (const double theta : {0.3, 0.9}) {
      const double tilt = tilt_of_turn(turn, theta);
      EXPECT_NEAR(crease_turn(tilt, theta), turn, 1e-14);
      EXPECT_NEAR(theta_of_turn(turn, tilt), theta, 1e-14);
    }
  EXPECT_EQ(theta_of_turn(1.5, 0.1), std::asin(1.0)) << "a tilt that never turns as far";
}

}  // namespace
}  // namespace kinetix::model
