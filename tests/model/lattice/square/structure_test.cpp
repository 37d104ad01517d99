#include "model/lattice/square/structure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <set>

#include "model/base/invalid_input.hpp"

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

}  // namespace
}  // namespace kinetix::model
