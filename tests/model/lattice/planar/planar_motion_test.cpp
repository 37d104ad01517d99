#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "model/base/invalid_input.hpp"
#include "model/closure/mobility.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;
using testing::disc_of_squares;
using testing::random_quads;
using testing::random_redrawing;

struct NamedGraph {
  const char* name;
  PlanarGraph graph;
  std::size_t bodies, hinges, cells;
};

std::vector<NamedGraph> graphs() {
  return {{"squares", square_graph(7, 5), 48, 82, 35},
          {"disc of squares", disc_of_squares(12), 109, 196, 88},
          {"rhombi", lattice_graph(model::rhombus_lattice, 6, 4, 1.1), 35, 58, 24},
          {"random quads", random_quads(6, 1), 49, 84, 36},
          {"honeycomb", lattice_graph(model::honeycomb_lattice, 5, 4), 58, 77, 20},
          {"bricks", lattice_graph(model::brick_lattice, 5, 4), 58, 77, 20},
          {"octagons", lattice_graph(model::octagon_lattice, 4, 3), 62, 79, 18}};
}

TEST(PlanarGraph, OfLatticesHasTheirBodiesHingesAndCells) {
  for (const NamedGraph& g : graphs()) {
    const PlanarStructure s = make_planar_structure(g.graph, {});
    EXPECT_EQ(s.graph.vertices.size(), g.bodies) << g.name;
    EXPECT_EQ(s.hinges.size(), g.hinges) << g.name;
    EXPECT_EQ(s.faces.size(), g.cells) << g.name;
    EXPECT_EQ(g.bodies + g.cells, g.hinges + 1) << g.name << ": Euler's formula";
    for (const GraphEdge& e : s.graph.edges) EXPECT_EQ(s.senses[e.from], -s.senses[e.to]) << g.name;
  }
}

TEST(PlanarMotion, OfAnyRedrawingClosesEveryHinge) {
  for (const NamedGraph& g : graphs()) {
    PlanarStructure s = make_planar_structure(g.graph, {});
    const ParallelDrawing y = random_redrawing(s, 0.5, 3);
    place_hinges(y, s);
    const Linkage linkage = s;
    for (const double theta : {-1.2, -0.3, 0.1, 0.7, 1.5}) {
      EXPECT_LE(hinge_gaps(linkage, fold(s, y, theta)).max, 1e-14) << g.name;
      EXPECT_LE(hinge_gaps(linkage, fold(s, y, theta)).axis_max, 1e-14) << g.name;
    }
    const ExactMotion motion = exact_motion(s);
    ASSERT_TRUE(motion) << g.name << ": " << motion.why;
    EXPECT_LE(aligned_distance(linkage, motion.at(0.4), fold(s, y, 0.4)).max, 1e-13) << g.name;
  }
}

TEST(PlanarMotion, TurnsAndScalesWallsAsItsRedrawingSays) {
  PlanarStructure s = make_planar_structure(lattice_graph(model::octagon_lattice, 3, 3), {});
  const ParallelDrawing y = random_redrawing(s, 0.5, 5);
  constexpr double theta = 0.6;
  const State state = fold(s, y, theta);
  for (int e = 0; e < static_cast<int>(s.graph.edges.size()); ++e) {
    const auto [turn, scale] = change_of(s, y, e);
    const Vector2d before = s.graph.along(e);
    const Vector2d after =
        (state[s.graph.edges[e].to].p - state[s.graph.edges[e].from].p).head<2>() / s.size.edge_mm;
    const double along = std::cos(theta) - 2 * scale * std::sin(theta), across = turn * std::sin(theta);
    EXPECT_NEAR(after.dot(before), along * before.squaredNorm(), 1e-13);
    EXPECT_NEAR(before.x() * after.y() - before.y() * after.x(), across * before.squaredNorm(), 1e-13);
  }
}

TEST(PlanarMotion, HasF1AsItsSpecialCase) {
  std::mt19937 random(7);
  for (int round = 0; round < 5; ++round) {
    const auto design = testing::random_design(Family::F1, 4, 3, random);
    const Structure squares = testing::structure_of(design);
    PlanarStructure s = make_planar_structure(square_graph(4, 3), squares.size);
    for (int e = 0; e < static_cast<int>(s.hinges.size()); ++e) {
      const auto vertex = [&](int v) {
        const Vector2d& p = s.graph.vertices[v];
        return Vertex{static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))};
      };
      const Vertex from = vertex(s.graph.edges[e].from), to = vertex(s.graph.edges[e].to);
      const Wall wall{from, from.i == to.i ? Axis::y : Axis::x};
      s.hinges[e].t = squares.hinges[*squares.hinge_at(wall)].parameters.t;
    }
    const ExactMotion motion = exact_motion(s);
    ASSERT_TRUE(motion) << motion.why;
    const State expected = fold(classify(squares), squares, 0.5), found = motion.at(0.5);
    for (std::size_t v = 0; v < found.size(); ++v) {
      const Vector2d& p = s.graph.vertices[v];
      const int body =
          *squares.body_at({static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))});
      const Eigen::Vector3d off = found[v].p - expected[body].p - (found[0].p - expected[0].p);
      EXPECT_LE(off.norm(), 1e-12);
    }
  }
}

// Sums over walls of length 1e5 round by 1e-11. A displaced hinge next to walls of length 1 is still detected.
TEST(PlanarMotion, ClosesFacesOfLongWallsAsOfShortOnes) {
  PlanarStructure s = make_planar_structure(testing::growing_squares(7, 8), {});
  for (std::size_t h = 0; h < s.hinges.size(); ++h) {
    const auto [from, to] = s.graph.edges[h];
    const Vector2d along = s.graph.along(static_cast<int>(h));
    s.hinges[h].t = (1 + s.senses[from] * 0.9 * std::sin(along.norm())) / 2;
  }
  const ExactMotion motion = exact_motion(s);
  EXPECT_TRUE(motion) << motion.why;
  s.hinges[0].t += 1e-10;
  EXPECT_FALSE(exact_motion(s));
}

TEST(PlanarMotion, NamesAFaceThatDoesNotClose) {
  PlanarStructure s = make_planar_structure(lattice_graph(model::honeycomb_lattice, 3, 3), {});
  s.hinges[4].t = 0.6;
  const ExactMotion motion = exact_motion(s);
  EXPECT_FALSE(motion);
  EXPECT_THAT(motion.why, ::testing::HasSubstr("does not close: it is off by 0.2 cell edges"));
  s.hinges[4] = {.beta = 0.1};
  EXPECT_THAT(exact_motion(s).why, ::testing::HasSubstr("leans, and upright hinges join both sides of it"));
}

// A square panel has one degree of freedom, whatever its offsets; a plain honeycomb has 4 n - 1.
TEST(PlanarMotion, HasTheMobilityOfItsLattice) {
  struct Case {
    PlanarGraph graph;
    int dofs;
  };
  for (const auto& [graph, dofs] :
       {Case{square_graph(4, 4), 1}, Case{lattice_graph(model::rhombus_lattice, 4, 3, 1.2), 1},
        Case{random_quads(4, 2), 1}, Case{lattice_graph(model::honeycomb_lattice, 3, 3), 11}}) {
    PlanarStructure s = make_planar_structure(graph, {});
    place_hinges(random_redrawing(s, 0.3, 11), s);
    const Mobility m = mobility(s, exact_motion(s));
    EXPECT_EQ(m.verdict, Verdict::mobile) << m.why;
    EXPECT_EQ(m.dofs_along, dofs);
  }
}

void expect_refused(const PlanarGraph& graph, const std::string& what) {
  try {
    make_planar_structure(graph, {});
    ADD_FAILURE() << "not refused: " << what;
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.reason(), ::testing::HasSubstr(what));
  }
}

TEST(PlanarGraph, SaysWhatIsWrongWithADrawing) {
  const std::vector<Vector2d> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<GraphEdge> rim = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const auto with = [&](GraphEdge e) {
    auto edges = rim;
    edges.push_back(e);
    return edges;
  };
  expect_refused({{{0, 0}, {1, 0}, {0, 1}}, {{0, 1}, {1, 2}, {2, 0}}},
                 "the face of vertices 0, 1, 2 has 3 walls");
  expect_refused({square, with({0, 2})}, "has 3 walls");
  expect_refused({square, {{0, 2}, {1, 3}, {0, 1}}},
                 "the wall from vertex 0 to 2 crosses the wall from vertex 1 to 3");
  expect_refused({square, with({1, 0})}, "is there twice");
  expect_refused({square, with({2, 2})}, "has no length");
  expect_refused({square, with({2, 4})}, "vertices go from 0 to 3");
  expect_refused({{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {0.5, 2}}, with({4, 5})},
                 "vertex 4 at (0.5, 0) lies on the wall from vertex 0 to 1. Split that wall there");
  expect_refused({{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {5, 5}, {6, 5}}, with({4, 5})}, "are not connected");
  expect_refused({{{0, 0}, {NAN, 0}}, {{0, 1}}}, "is not finite");
  expect_refused({{{0, 0}}, {}}, "at least two vertices");
}

// Walls are compared where they pass near each other, even if one of them is long.
TEST(PlanarGraph, TakesALongWallAmongManyShortOnes) {
  PlanarGraph graph = square_graph(60, 60);
  const int last = static_cast<int>(graph.vertices.size()) - 1;
  for (const double slope : {1.0, 0.3, 4.0, 0.0}) {
    graph.vertices.push_back(graph.vertices[last] + 1e4 * Vector2d(1, slope));
    graph.edges.push_back({last, static_cast<int>(graph.vertices.size()) - 1});
  }
  graph.vertices.push_back(graph.vertices[last] + Vector2d(0, 1e4));
  graph.edges.push_back({last, static_cast<int>(graph.vertices.size()) - 1});
  EXPECT_NO_THROW(validate(graph));
  for (const double slope : {0.7, 0.01, 50.0}) {
    PlanarGraph crossed = graph;
    crossed.vertices.push_back(graph.vertices[0] + 3e3 * Vector2d(-1, -slope));
    crossed.vertices.push_back(graph.vertices[last] + Vector2d(20, 20 * slope));
    const int from = static_cast<int>(graph.vertices.size());
    crossed.edges.push_back({from, from + 1});
    EXPECT_THROW(validate(crossed), InvalidInput) << slope;
  }
}

// A wall that ends inside a cell is walked there and back: the cell is what is round it.
TEST(PlanarGraph, LeavesWallsThatEndInACellOutOfItsLoop) {
  const PlanarGraph graph{{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}}};
  const auto faces = bounded_faces(graph);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].vertices.size(), 4u);
}

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
ParallelDrawing sheared(const PlanarStructure& s, double by) {
  ParallelDrawing y;
  for (const Eigen::Vector2d& x : s.graph.vertices) y.emplace_back(by * x.x(), -by * x.y());
  return y;
}

TEST(PlanarDrive, GripsTheOutermostLinesOfVertices) {
  const GrippedRows bricks = boundary_rows(panels()[3], Axis::y);
  EXPECT_EQ(bricks[0], (std::vector{0, 1, 2, 3, 4, 5, 6})) << "three bricks side by side";
  EXPECT_EQ(bricks[1].size(), 7u);
  for (const PlanarStructure& s : panels()) {
    const Axis axis = drive_to(s, 0.1).axis;
    const int along = axis == Axis::x ? 0 : 1;
    const GrippedRows rows = boundary_rows(s, axis);
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
  EXPECT_THAT(refusal([&] { boundary_rows(rhombi, Axis::x); }), HasSubstr("allowed: y, or kind: hinge"));
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
  ParallelDrawing y = sheared(s, 0);
  y[3].x() += 0.3;
  y[0].y() += 0.3;
  place_hinges(y, s);
  const ExactMotion motion = exact_motion(s);
  ASSERT_TRUE(motion) << motion.why;
  EXPECT_FALSE(keeps_rows_straight(y, Axis::y, boundary_rows(s, Axis::y)));
  EXPECT_THAT(refusal([&] { motion.theta_of(plate_drive(s, Axis::y, 0.1, 1)); }),
              HasSubstr("plates normal to y would keep rows straight that curve in this panel's motion"));
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
