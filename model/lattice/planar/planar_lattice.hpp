#pragma once

#include <array>
#include <functional>
#include <numbers>
#include <string_view>
#include <vector>

#include "model/lattice/planar/planar_graph.hpp"

namespace kinetix::model {

/// A regular lattice: one polygon of walls of length 1, repeated in columns and rows.
struct PlanarLattice {
  std::string_view name;     ///< `structure.lattice` of a file
  std::string_view meaning;  ///< for the documentation
  /// Corners of cell [column, row], which may be negative, counter-clockwise, cell edges. @param angle rad, of lattices that take one
  std::vector<Eigen::Vector2d> (*corners)(int column, int row, double angle);
  bool takes_angle = false;  ///< whether the shape of its cells is a matter of choice
};

/// [column, row], from [0, 0].
using LatticeCell = std::array<int, 2>;

/// 1 of odd rows and 0 of even ones, of negative rows too: lattices shift odd rows against even ones.
inline int odd_row(int row) { return row & 1; }

/// columns x rows cells, row by row.
std::vector<LatticeCell> lattice_cells(int columns, int rows);

/// Cells of a lattice, and how they were drawn: what files say of a sheet, to write it again.
struct LatticeSheet {
  const PlanarLattice* lattice = nullptr;
  std::vector<LatticeCell> cells;
  double angle = std::numbers::pi / 3;  ///< rad, of lattices that take one
  bool closed_rim = false;              ///< closed_rim() of them
};

/// The walls of these cells; vertices from below, and from the left in a row. Cells that share a wall have it
/// once. (Polygons that others enclose are cells of the graph as well.)
PlanarGraph lattice_graph(const LatticeSheet& sheet);
/// Of a rectangle of cells with an open rim. @param angle rad, of lattices that take one
PlanarGraph lattice_graph(const PlanarLattice& lattice, int columns, int rows, double angle = 0);

/// What is left of a graph where all corners of a face must lie in a region: the faces inside, in the largest
/// piece that hangs together by walls. @throws InvalidInput where no face lies inside
PlanarGraph trimmed(const PlanarGraph& graph, const std::function<bool(const Eigen::Vector2d&)>& inside);

}  // namespace kinetix::model
