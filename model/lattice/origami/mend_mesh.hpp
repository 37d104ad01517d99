#pragma once

#include "model/lattice/origami/crease_signs.hpp"

namespace kinetix::model {

/// A mesh that folds flat and rigidly, near another one.
struct MendedMesh {
  QuadMesh mesh;     ///< with multipliers; that of the steepest crease: 1
  double moved = 0;  ///< largest move of a vertex, mean edges
};

/// Limit of moves of vertices, mean edges.
inline constexpr double most_moved = 0.03;

/// Moves the vertices of a mesh as little as possible, in the least-squares sense, until it folds flat and rigidly to
/// the last digit. The conditions are local, with sectors a, b, c, d about an inner vertex. r is its fold_ratio(a, b).
///
///     a + c = pi
///
///     r(i, j) r(i + 1, j + 1) = r(i + 1, j) r(i, j + 1).
///
/// @param mesh with the signs of all creases in `rising` and `level`   @param name of vertices in messages
/// @throws InvalidInput, naming a vertex, if a vertex would move by more than `most_moved`
MendedMesh mend_mesh(const QuadMesh& mesh, const VertexName& name);

}  // namespace kinetix::model
