#include <gtest/gtest.h>
#include <cmath>

#include "model/lattice/planar/planar_lattice.hpp"
#include "model/lattice/planar/regular_lattices.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

Vector2d middle(const PlanarLattice& lattice, int i, int j) {
  const auto corners = lattice.corners(i, j, 0);
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& corner : corners) sum += corner;
  return sum / static_cast<double>(corners.size());
}

TEST(LatticeCut, HangsTogetherAcrossRowsBelowZero) {
  for (const PlanarLattice* lattice : {&honeycomb_lattice, &brick_lattice}) {
    // A cell of row -1 lies half a cell to the right of the one with its number in row 0, so [-1, -1] is its lower left neighbour.
    const Vector2d upper = middle(*lattice, 0, 0),
                   lower = upper - lattice_pitch(*lattice, 0).column / 2 - lattice_pitch(*lattice, 0).row;
    const auto cells = cut_cells(*lattice, 3, 3, 0, [&](const Vector2d& p) {
      return (p - upper).norm() < 0.1 || (p - lower).norm() < 0.1;
    });
    ASSERT_EQ(cells.size(), 2u) << lattice->name;
    EXPECT_EQ(lattice_graph({lattice, cells, 0}).edges.size(), 11u)
        << lattice->name << ": two hexagons share a wall";
    EXPECT_EQ(cells.front()[1] & 1, 1) << "the row below zero stays an odd one";
  }
}

TEST(LatticeCut, KeepsTheLargestPieceAndStartsAtZero) {
  // The shape covers the two upper rows of 4 x 4 hexagons, and a separate cell below them.
  const Vector2d alone = middle(honeycomb_lattice, 3, 0);
  const LatticePitch pitch = lattice_pitch(honeycomb_lattice, 0);
  const auto cells = cut_cells(honeycomb_lattice, 4, 4, 0, [&](const Vector2d& p) {
    const double column = p.x() / pitch.column.x(), row = p.y() / pitch.row.y();
    return (column > -0.25 && column < 3.75 && row > 1.5 && row < 3.5) || (p - alone).norm() < 0.1;
  });
  ASSERT_EQ(cells.size(), 8u);
  EXPECT_EQ(cells.front(), (LatticeCell{0, 0}));
  EXPECT_EQ(cells.back(), (LatticeCell{3, 1}));
}

TEST(LatticeCut, ABoxHoldsAllCorners) {
  const Eigen::AlignedBox2d box = lattice_box(honeycomb_lattice, 4, 4, 0);
  const double width = std::sqrt(3.0);  // of a hexagon
  EXPECT_NEAR((box.min() - Vector2d(-width / 2, -1)).norm(), 0, 1e-14);
  EXPECT_NEAR((box.max() - Vector2d(4 * width, 5.5)).norm(), 0, 1e-14);
}

TEST(LatticeCut, OfNothingIsNothing) {
  EXPECT_TRUE(cut_cells(brick_lattice, 3, 3, 0, [](const Vector2d&) { return false; }).empty());
}

}  // namespace
}  // namespace kinetix::model
