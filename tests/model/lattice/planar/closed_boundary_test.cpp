#include <gtest/gtest.h>

#include "model/base/invalid_input.hpp"
#include "model/closure/mobility.hpp"
#include "model/lattice/planar/closed_boundary.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

// Columns and rows: even and odd, more of the one and of the other.
constexpr std::pair<int, int> sizes[] = {{2, 2}, {3, 2}, {2, 3}, {3, 3}, {4, 4}, {5, 3}, {6, 6}};
// Lattices that are underconstrained unless their boundary is closed.
constexpr const PlanarLattice* floppy[] = {&honeycomb_lattice, &brick_lattice, &octagon_lattice};

std::string name(const PlanarLattice& lattice, int columns, int rows) {
  return std::string(lattice.name) + " " + std::to_string(columns) + " x " + std::to_string(rows);
}

void expect_dofs(const PlanarStructure& s, int dofs) {
  const Mobility m = mobility(s, exact_motion(s));
  EXPECT_EQ(m.verdict, Verdict::mobile) << m.why;
  EXPECT_EQ(m.dofs_along, dofs) << m.why;
}

TEST(CountedFreedoms, AreOneOfACellAndFourNLessOneOfAnOpenHoneycomb) {
  EXPECT_EQ(counted_dofs(square_graph(1, 1)), 1);
  EXPECT_EQ(counted_dofs({{{0, 0}, {1, 0}}, {{0, 1}}}), 1) << "two bodies and their hinge";
  for (const int n : {1, 2, 3, 5, 8}) {
    EXPECT_EQ(counted_dofs(lattice_graph(honeycomb_lattice, n, n)), 4 * n - 1) << n;
    EXPECT_EQ(counted_dofs(lattice_graph(brick_lattice, n, n)), 4 * n - 1) << n;
  }
}

TEST(WallDofs, AreOneOfQuadrilateralsAndWhatIsCountedOfFloppyPanels) {
  for (const PlanarGraph& graph :
       {square_graph(1, 1), square_graph(6, 5), testing::random_quads(4, 2), testing::disc_of_squares(8)})
    EXPECT_EQ(WallDofs(graph).count(), 1);
  for (const PlanarLattice* lattice : floppy) {
    const PlanarGraph open = lattice_graph(*lattice, 4, 3);
    EXPECT_EQ(WallDofs(open).count(), counted_dofs(open));
  }
}

// One half is overconstrained, the other is free.
TEST(WallDofs, AreRightWhereOnePartRepeatsItsWalls) {
  PlanarGraph graph = square_graph(4, 4);
  const int last = static_cast<int>(graph.vertices.size()) - 1;
  for (const Vector2d& p : {Vector2d(5, 4), Vector2d(6, 4), Vector2d(6, 5), Vector2d(5, 5), Vector2d(4, 5)})
    graph.vertices.push_back(p);
  for (int k = 0; k < 5; ++k) graph.edges.push_back({last + k, last + k + 1});
  graph.edges.push_back({last + 5, last});
  EXPECT_LT(counted_dofs(graph), 1);
  EXPECT_EQ(WallDofs(graph).count(), 4) << "one of the squares, three of a hexagon with the sheet as a body";
  const PlanarStructure s = make_planar_structure(graph, {});
  expect_dofs(s, WallDofs(graph).count());
}

TEST(ClosedBoundary, LeavesOneOfTheFourNLessOneFreedomsOfAHoneycomb) {
  for (const int n : {2, 3, 4}) {
    SCOPED_TRACE(n);
    expect_dofs(make_planar_structure(lattice_graph(honeycomb_lattice, n, n), {}), 4 * n - 1);
    expect_dofs(make_planar_structure({&honeycomb_lattice, lattice_cells(n, n), 0, true}, {}), 1);
  }
}

TEST(ClosedBoundary, GivesEveryFloppyPanelOneFreedomAndEvenFaces) {
  for (const PlanarLattice* lattice : floppy)
    for (const auto& [columns, rows] : sizes) {
      SCOPED_TRACE(name(*lattice, columns, rows));
      const PlanarGraph open = lattice_graph(*lattice, columns, rows);
      const PlanarGraph closed = closed_boundary(open);
      EXPECT_GT(counted_dofs(open), 1);
      EXPECT_EQ(counted_dofs(closed), 1);
      EXPECT_NO_THROW(validate(closed));
      for (const GraphFace& face : bounded_faces(closed)) EXPECT_EQ(face.vertices.size() % 2, 0u);
      expect_dofs(make_planar_structure(closed, {}), 1);
    }
}

TEST(ClosedBoundary, AddsToAPanelAndMovesNothingInIt) {
  for (const PlanarLattice* lattice : floppy) {
    const PlanarGraph open = lattice_graph(*lattice, 4, 3), closed = closed_boundary(open);
    ASSERT_GE(closed.vertices.size(), open.vertices.size());
    for (std::size_t v = 0; v < open.vertices.size(); ++v) EXPECT_EQ(closed.vertices[v], open.vertices[v]);
    for (std::size_t e = 0; e < open.edges.size(); ++e) EXPECT_EQ(closed.edges[e], open.edges[e]);
  }
}

TEST(ClosedBoundary, LeavesPanelsOfOneFreedomAsTheyAre) {
  for (const PlanarGraph& graph : {square_graph(4, 3), lattice_graph(rhombus_lattice, 3, 3, 1.1)}) {
    const PlanarGraph closed = closed_boundary(graph);
    EXPECT_EQ(closed.vertices.size(), graph.vertices.size());
    EXPECT_EQ(closed.edges, graph.edges);
  }
}

// Outlines cut panels to any shape: what is added must never cross, touch or make an odd face.
TEST(ClosedBoundary, OfPanelsCutToAnyOutlineIsADrawingThatFolds) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> size(2, 5), part(0, 1);
  for (int round = 0; round < 60; ++round) {
    const PlanarLattice& lattice = *floppy[round % 3];
    SCOPED_TRACE(std::string(lattice.name) + " round " + std::to_string(round) + " seed 17");
    const PlanarGraph whole = lattice_graph(lattice, 7, 7);
    Vector2d middle = Vector2d::Zero();
    for (const Vector2d& p : whole.vertices) middle += p / static_cast<double>(whole.vertices.size());
    middle += Vector2d(part(random), part(random));
    const Vector2d radius(size(random), size(random));
    const PlanarGraph cut =
        trimmed(whole, [&](const Vector2d& p) { return (p - middle).cwiseQuotient(radius).norm() <= 1; });
    const PlanarGraph closed = closed_boundary(cut);
    EXPECT_NO_THROW(make_planar_structure(closed, {}));
    EXPECT_LE(counted_dofs(closed), std::max(1, counted_dofs(cut)));
  }
}

// A cell whose corners lie on long straight sides has bars along these sides, which are walls already.
TEST(ClosedBoundary, PutsNoWallAlongTheSideOfACell) {
  PlanarGraph graph;
  for (int k = 0; k < 5; ++k) graph.vertices.emplace_back(k, 0);
  for (int k = 4; k >= 0; --k) graph.vertices.emplace_back(k, 8);
  for (int k = 0; k < 10; ++k) graph.edges.push_back({k, (k + 1) % 10});
  EXPECT_NO_THROW(make_planar_structure(closed_boundary(graph), {}));
}

/// A cut that faces itself across a gap of one brick, into which two corners would both put a vertex.
TEST(ClosedBoundary, PutsNoTwoVerticesInOnePlace) {
  const std::vector<LatticeCell> star = {{1, 0}, {3, 0}, {1, 1}, {2, 1}, {1, 2}, {2, 2}, {0, 3}, {1, 3},
                                         {2, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}, {1, 5}, {2, 5}, {2, 6}};
  const PlanarGraph closed = lattice_graph({&brick_lattice, star, 0, true});
  EXPECT_NO_THROW(validate(closed));
  EXPECT_EQ(counted_dofs(closed), 1);
}

}  // namespace
}  // namespace kinetix::model
