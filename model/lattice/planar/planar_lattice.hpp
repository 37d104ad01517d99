#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <numbers>
#include <string_view>

#include "model/lattice/planar/planar_graph.hpp"

namespace kinetix::model {

/// A regular lattice: one polygon of walls of length 1, repeated in columns and rows.
struct PlanarLattice {
  std::string_view name;     ///< value of `structure.lattice` in a file
  std::string_view meaning;  ///< description for the documentation
  /// Corners of cell [column, row], which may be negative, counter-clockwise, cell edges. @param angle rad, for
  /// lattices with an angle
  std::vector<Eigen::Vector2d> (*corners)(int column, int row, double angle);
  bool needs_angle = false;  ///< true if the shape of its cells depends on the angle
};

/// [column, row], from [0, 0].
using LatticeCell = std::array<int, 2>;

/// Returns 1 for odd rows and 0 for even ones, also for negative rows: lattices shift odd rows relative to even ones.
inline int odd_row(int row) { return row & 1; }

/// Returns columns x rows cells, row by row.
std::vector<LatticeCell> lattice_cells(int columns, int rows);

/// Cells of a lattice and the parameters of the drawing, as in files, so that a sheet can be written again.
struct LatticeSheet {
  const PlanarLattice* lattice = nullptr;
  std::vector<LatticeCell> cells;
  double angle = std::numbers::pi / 3;  ///< rad, for lattices with an angle
  bool closed_boundary = false;         ///< true: closed_boundary() was applied to them
};

/// Returns the walls of these cells; vertices are ordered from below, and from the left in a row. A shared wall is
/// stored once. (Polygons that others enclose are cells of the graph too.)
PlanarGraph lattice_graph(const LatticeSheet& sheet);
/// Returns the graph of a rectangle of cells with an open boundary. @param angle rad, for lattices with an angle
PlanarGraph lattice_graph(const PlanarLattice& lattice, int columns, int rows, double angle = 0);

/// Returns the graph of the faces with all corners in a region, reduced to the largest piece that is connected by
/// walls. @throws InvalidInput if no face is inside
PlanarGraph trimmed(const PlanarGraph& graph, const std::function<bool(const Eigen::Vector2d&)>& inside);

/// Vector to the next cell of a row, and half of the vector to the second row above (odd rows may be shifted), cell
/// edges.
struct LatticePitch {
  Eigen::Vector2d column, row;
};
/// @param angle rad, for lattices with an angle
LatticePitch lattice_pitch(const PlanarLattice& lattice, double angle);

/// Returns the box around columns x rows cells, cell edges.
Eigen::AlignedBox2d lattice_box(const PlanarLattice& lattice, int columns, int rows, double angle);

/// Returns cells whose middle is in a region, from a rectangle of columns x rows and a few cells around it. Only the
/// largest piece that is connected by walls is returned. It is moved to start at [0, 0] (rows by an even number), row
/// by row. Empty if no cell is in the region.
/// @param inside predicate in cell edges
std::vector<LatticeCell> cut_cells(const PlanarLattice& lattice, int columns, int rows, double angle,
                                   const std::function<bool(const Eigen::Vector2d& middle)>& inside);

}  // namespace kinetix::model
