#pragma once

#include "app/files/crease_pattern.hpp"
#include "model/lattice/origami/quad_mesh.hpp"

namespace kinetix::app {

/// A pattern of quadrilaterals in columns and rows.
struct QuadGrid {
  model::QuadMesh mesh;        ///< `rising` and `level`: 1 for valleys, -1 for mountains, 0 if not known
  std::vector<int> vertex_of;  ///< vertex of the pattern for each vertex of the mesh
};

/// Finds the columns and rows of a pattern, from one of its corners.
/// @throws InvalidInput for a pattern with other faces, with other than four creases at an inner vertex, or without
/// columns and rows. The message counts what does not fit in the whole pattern.
QuadGrid find_quad_grid(const CreasePattern& pattern);

}  // namespace kinetix::app
