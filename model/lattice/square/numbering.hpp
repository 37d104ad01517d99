#pragma once

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

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
