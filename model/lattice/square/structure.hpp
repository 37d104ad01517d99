#pragma once

#include <compare>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// A lattice vertex (i along +x, j along +y) with one rigid body.
struct Vertex {
  int i = 0, j = 0;
  auto operator<=>(const Vertex&) const = default;
  /// Returns true for sublattice A of the checkerboard: i + j even.
  bool is_in_sublattice_a() const { return ((i + j) & 1) == 0; }
  /// Returns +1 for sublattice A, -1 for B: in planar motion A turns by +theta, B by -theta.
  int sense() const { return is_in_sublattice_a() ? 1 : -1; }
};

/// A lattice cell, named by its bottom-left vertex.
struct Cell {
  int i = 0, j = 0;
  auto operator<=>(const Cell&) const = default;
};

/// The lattice edge from `from` one step along +axis: a plate divided in two by its hinge.
struct Wall {
  Vertex from;
  Axis axis = Axis::x;
  auto operator<=>(const Wall&) const = default;
  Vertex to() const { return axis == Axis::x ? Vertex{from.i + 1, from.j} : Vertex{from.i, from.j + 1}; }
};

/// Returns the text in a file: "[i, j]", and "[[i, j], [i, j]]" for a wall.
std::string to_string(Vertex vertex);
std::string to_string(const Cell& cell);
std::string to_string(const Wall& wall);
/// Returns the name of a wall's line of cells: "column 3" for a wall along x, otherwise "row 2". In a strip, which
/// has only columns, it is the column.
std::string line_name(const Wall& wall, bool in_strip);

/// Returns the indices {i, j}, as in result.json.
std::vector<int> label(Vertex vertex);
std::vector<int> label(const Cell& cell);

/// Returns the position of a vertex at rest, cell edges.
Eigen::Vector3d rest_place(Vertex vertex);

struct Hinge {
  Wall wall;
  int lower = 0;  ///< index of the body on wall.from
  int upper = 0;  ///< index of the body on wall.to()
  HingeParameters parameters = {};
};

/// Walls counter-clockwise from the bottom-left corner: bottom, right, top, left.
struct CellHinges {
  std::array<int, 4> bodies;
  std::array<int, 4> hinges;
};

/// A set of lattice cells with one body per vertex and one hinge per wall (kinematics.md section 1).
struct Structure {
  CellSize size;
  std::vector<Cell> cells;               ///< sorted, no duplicates
  std::vector<Vertex> bodies;            ///< sorted by (i, j)
  std::vector<Hinge> hinges;             ///< in the order of the first cell with each
  std::vector<CellHinges> cell_members;  ///< one per cell

  std::optional<int> body_at(Vertex v) const;
  std::optional<int> hinge_at(const Wall& wall) const;

  Eigen::Vector3d rest_position(int body) const;  ///< mm
  /// Returns the hinge point at rest, mm.
  Eigen::Vector3d hinge_point(const Hinge& hinge) const;

  /// Converts to a linkage with bodies, hinges and cells in the same order. The conversion is implicit; code that
  /// needs the linkage repeatedly should convert once.
  operator Linkage() const;
};

HingedWall hinged_wall(const Hinge& hinge);
RestHinge rest_hinge(const Hinge& hinge);

/// Creates a structure with basic hinges. @throws InvalidInput. Cells must exist, be unique, without negative
/// indices, and be connected by shared walls or vertices. Sizes must be positive, and walls thinner than half the
/// edge. The limits are a million cells and 4 million vertices of the lattice from [0, 0] over all cells, on which
/// the exact families are computed.
Structure make_structure(std::vector<Cell> cells, const CellSize& size);

/// Checks the size of a sheet. @throws InvalidInput unless columns and rows are at least 1 and their product is at
/// most a million
void check_extent(int columns, int rows);
/// Returns columns x rows cells from (0, 0), sorted. @throws InvalidInput as check_extent()
std::vector<Cell> rectangle(int columns, int rows);
/// Creates the structure of columns x rows cells. @throws InvalidInput as make_structure
Structure make_sheet(int columns, int rows, const CellSize& size);

/// Returns the label of a body or cell in results, by its indices: as many integers as the lattice needs.
std::vector<int> body_label(const Structure& structure, int body);
std::vector<int> cell_label(const Structure& structure, int cell);

/// Checks the hinge parameters. @throws InvalidInput, naming wall and value, for one outside its range (NaN included)
void validate_hinges(const Structure& structure);

/// Returns the row of a vertex along an axis: its column i for x, its row j for y.
inline int row_along(Axis axis, Vertex v) { return axis == Axis::x ? v.i : v.j; }

/// Returns the up-direction of a wall plate at rest, unit length; beta in rad. More in model/linkage/linkage.hpp.
Eigen::Vector3d wall_up(Axis axis, double beta);
/// Returns true if the hinge axis is along z at rest, to 1e-9 rad.
bool is_vertical(const Hinge& hinge);
/// Returns true if all hinge axes are along z: then the structure moves in the plane.
bool all_vertical(const Structure& structure);
/// Returns the hinge axis at rest, unit length.
Eigen::Vector3d hinge_axis(Axis axis, const HingeParameters& parameters);

/// Returns the number of columns (axis x) or rows (axis y) of walls, counted from 0 at the lattice's origin.
int line_count(const Structure& structure, Axis axis);
/// Returns the column or row of a wall.
int line_of(const Wall& wall);
/// Returns the hinges of the x-walls of column `line`, or of the y-walls of row `line`; ascending.
std::vector<int> hinges_on_line(const Structure& structure, Axis axis, int line);
/// Returns true if a wall's lower vertex is of sublattice B: its t is then 1 minus the fraction of sublattice A.
bool starts_in_sublattice_b(const Wall& wall);

/// Returns the bodies of each column of vertices with bodies, both ascending.
std::vector<std::vector<int>> body_columns(const Structure& structure);

/// Numbering of columns, rows and bodies on a whole lattice from (0, 0), column by column, from 0.

/// Returns the number of bodies of a lattice of columns x rows cells.
inline std::size_t lattice_bodies(std::size_t columns, std::size_t rows) {
  return (columns + 1) * (rows + 1);
}
/// Returns the body on a vertex of a lattice with `rows` rows of cells.
inline int lattice_body(Vertex vertex, int rows) { return vertex.i * (rows + 1) + vertex.j; }
/// Returns the number of columns of vertices of a lattice with this number of bodies.
inline int vertex_columns(std::size_t bodies, int rows) {
  return static_cast<int>(bodies / static_cast<std::size_t>(rows + 1));
}

/// Returns +1 for even columns, -1 for odd ones: tilts and turns alternate with it. @pre column >= 0
inline int column_sign(int column) { return column % 2 == 0 ? 1 : -1; }

}  // namespace kinetix::model
