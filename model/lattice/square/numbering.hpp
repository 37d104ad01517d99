#pragma once

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// How columns and rows are counted on a whole lattice from (0, 0), whose bodies stand column by column. All from 0.

/// Bodies of a lattice of columns x rows cells.
inline std::size_t lattice_bodies(std::size_t columns, std::size_t rows) {
  return (columns + 1) * (rows + 1);
}
/// Body on a vertex of a lattice with `rows` rows of cells.
inline int lattice_body(Vertex vertex, int rows) { return vertex.i * (rows + 1) + vertex.j; }
/// Columns of vertices, of so many bodies.
inline int vertex_columns(std::size_t bodies, int rows) {
  return static_cast<int>(bodies / static_cast<std::size_t>(rows + 1));
}

/// +1 of even columns, -1 of odd ones: tilts and turns alternate with it. @pre column >= 0
inline int column_sign(int column) { return column % 2 == 0 ? 1 : -1; }

}  // namespace kinetix::model
