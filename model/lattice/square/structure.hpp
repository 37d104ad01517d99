#pragma once

#include <Eigen/Core>
#include <array>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "model/linkage/axis.hpp"
#include "model/linkage/hinge_parameters.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/wall.hpp"

namespace kinetix::model {

/// A lattice vertex (i along +x, j along +y). One rigid body sits on each.
struct Vertex {
  int i = 0, j = 0;
  auto operator<=>(const Vertex&) const = default;
  /// Class A of the checkerboard: i + j even.
  bool is_class_a() const { return ((i + j) & 1) == 0; }
  /// +1 for class A, -1 for class B: in planar motion A turns by +theta, B by -theta.
  int sense() const { return is_class_a() ? 1 : -1; }
};

/// A lattice cell, named by its bottom-left vertex.
struct Cell {
  int i = 0, j = 0;
  auto operator<=>(const Cell&) const = default;
};

/// The lattice edge from `from` one step along +axis: a plate split in two by its hinge.
struct Wall {
  Vertex from;
  Axis axis = Axis::x;
  auto operator<=>(const Wall&) const = default;
  Vertex to() const { return axis == Axis::x ? Vertex{from.i + 1, from.j} : Vertex{from.i, from.j + 1}; }
};

/// "[i, j]", and "[[i, j], [i, j]]" for a wall: as they stand in a file.
std::string to_string(Vertex vertex);
std::string to_string(const Cell& cell);
std::string to_string(const Wall& wall);
/// The line of cells that a wall belongs to: "column 3" of a wall along x, else "row 2"; in a strip, which has columns
/// alone, its column.
std::string line_name(const Wall& wall, bool in_strip);

/// The same as integers, as they stand in result.json: {i, j}.
std::vector<int> label(Vertex vertex);
std::vector<int> label(const Cell& cell);

/// Where a vertex lies at rest, cell edges.
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
  std::vector<Hinge> hinges;             ///< in the order in which the cells first meet them
  std::vector<CellHinges> cell_members;  ///< one per cell

  std::optional<int> body_at(Vertex v) const;
  std::optional<int> hinge_at(const Wall& wall) const;

  Eigen::Vector3d rest_position(int body) const;  ///< mm
  /// Hinge point at rest, mm.
  Eigen::Vector3d hinge_point(const Hinge& hinge) const;

  /// The linkage that it makes: same bodies, hinges and cells in the same order. A structure stands wherever
  /// a linkage is needed; whoever needs it many times converts once.
  operator Linkage() const;
};

HingedWall hinged_wall(const Hinge& hinge);
RestHinge rest_hinge(const Hinge& hinge);

/// All hinges basic. @throws InvalidInput for no cells, a repeated cell, a negative index, sizes that are not
/// positive, a wall of half the edge or thicker, cells that do not hang together by shared walls or vertices,
/// more than a million cells, or a lattice from [0, 0] over all cells of more than 4 million vertices (the
/// exact families are computed on all of it).
Structure make_structure(std::vector<Cell> cells, const CellSize& size);

/// @throws InvalidInput unless columns and rows are at least 1 and their product is at most a million
void check_extent(int columns, int rows);
/// columns x rows cells from (0, 0), sorted. @throws InvalidInput as check_extent()
std::vector<Cell> rectangle(int columns, int rows);
/// The structure of these cells. @throws InvalidInput as make_structure
Structure make_sheet(int columns, int rows, const CellSize& size);

/// What results call a body and a cell, by their indices: as many integers as the lattice needs.
std::vector<int> body_label(const Structure& structure, int body);
std::vector<int> cell_label(const Structure& structure, int cell);

/// @throws InvalidInput, naming wall and value, for hinge parameters outside their ranges (NaN included)
void validate_hinges(const Structure& structure);

/// Row of a vertex along an axis: its column i for x, its row j for y.
inline int row_along(Axis axis, Vertex v) { return axis == Axis::x ? v.i : v.j; }

/// Up-direction of a wall plate at rest, unit length; beta in rad. More in model/linkage/wall.hpp.
Eigen::Vector3d wall_up(Axis axis, double beta);
/// Whether the hinge axis stands along z at rest, to 1e-9 rad.
bool is_vertical(const Hinge& hinge);
/// Then the structure moves in the plane.
bool all_vertical(const Structure& structure);
/// Hinge axis at rest, unit length.
Eigen::Vector3d hinge_axis(Axis axis, const HingeParameters& parameters);

}  // namespace kinetix::model
