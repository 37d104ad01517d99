#pragma once

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// A side of a rectangle of cells: the direction to its neighbour.
enum class Side { left, right, bottom, top };

std::string to_string(Side side);
Side opposite(Side side);
/// Returns the axis normal to a side: x for left and right.
Axis across(Side side);
/// Returns true for a side towards higher columns or rows: right and top.
bool is_upper(Side side);

/// The cells [i, i + width) x [j, j + height), `low` being (i, j). Its vertices are those of its cells, including
/// both ends. Indices may be negative.
struct CellRectangle {
  Cell low;
  int width = 0, height = 0;  ///< cells along x and y

  auto operator<=>(const CellRectangle&) const = default;

  int extent(Axis axis) const { return axis == Axis::x ? width : height; }  ///< cells
  bool is_empty() const { return width < 1 || height < 1; }

  /// Returns this rectangle moved beyond a side of `other`. `gap` cells are between them, and its lower end along
  /// that side is `shift` cells above the other's.
  CellRectangle beside(const CellRectangle& other, Side side, int gap, int shift = 0) const;
  /// Returns the rectangle with indices relative to `origin`, which becomes cell (0, 0).
  CellRectangle seen_from(const Cell& origin) const;
  /// Returns the rectangle turned by 90 deg about vertex (0, 0), from x to y.
  CellRectangle turned() const;
  /// Returns the rectangle mirrored in the y-axis: x becomes -x.
  CellRectangle mirrored() const;

  std::vector<Cell> cells() const;               ///< sorted; @pre not empty
  std::vector<Vertex> vertices() const;          ///< sorted
  std::vector<Vertex> rows_of_vertices() const;  ///< row by row, i counting within a row
  /// Returns its vertices except the first and last line across the axis, line by line along it.
  std::vector<Vertex> vertices_between_ends(Axis axis) const;
  /// Returns the walls of its cells along the axis, column by column for x and row by row for y. These walls tilt if
  /// its cells bend about fold lines across the axis.
  std::vector<Wall> walls_along(Axis axis) const;
  /// Returns the lower one of the two corners on a side.
  Vertex corner(Side side) const;
  /// Returns the vertex nearest to its middle; ties go to the lowest column and row.
  Vertex middle() const;
};

/// Returns the cells between a side of one rectangle and another beyond it, where the two face each other. Empty if
/// they do not.
CellRectangle gap_between(const CellRectangle& from, Side side, const CellRectangle& to);
/// Returns true if they have a common vertex.
bool touch(const CellRectangle& a, const CellRectangle& b);
/// Returns the smallest rectangle that contains them all. @pre at least one
CellRectangle bounds(const std::vector<CellRectangle>& rectangles);

/// Returns the bodies on its vertices, row by row: vertex (low.i + i, low.j + j) at j * (width + 1) + i.
/// @pre the structure has all its cells
std::vector<int> bodies_of(const CellRectangle& rectangle, const Structure& structure);
/// Returns the first and last index, in that order of its bodies, of each line of vertices along the axis.
std::vector<std::array<int, 2>> line_ends(const CellRectangle& rectangle, Axis axis);
/// Returns the body on its middle().
int middle_body(const CellRectangle& rectangle, const Structure& structure);

}  // namespace kinetix::model
