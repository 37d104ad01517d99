#pragma once

#include <functional>
#include <string>

#include "model/lattice/origami/quad_mesh.hpp"

namespace kinetix::model {

/// Name of vertex (i, j) of a mesh in messages.
using VertexName = std::function<std::string(int i, int j)>;

/// Result of solving for unknown mountains and valleys.
struct SolvedSigns {
  int solved = 0;          ///< number of creases whose sign was not given
  bool is_either = false;  ///< true if no sign was given: the sheet may also be turned over
};

/// Returns true if the level creases of an inner vertex have opposite folds and the rising ones equal folds; false in
/// the other case. @pre the signs of its four creases are set
bool level_flips(const QuadMesh& mesh, int i, int j);

/// Returns the multiplier of the level crease to the right over that of the rising crease above, at an inner vertex
/// with sectors a and b, rad. Both ways to fold a vertex are in kinematics.md section 6.
double fold_ratio(double a, double b, bool level_flips);

/// Least |multiplier| of a crease that folds, relative to the other creases of its vertex.
inline constexpr double least_fold_ratio = 1e-4;

/// Completes the signs of all creases, which `rising` and `level` contain: 1 for valleys, -1 for mountains, 0 if not
/// known. Unknown signs follow from the angles at all vertices, which leave few ways to fold the whole mesh. Without any
/// known sign, the first crease becomes a valley.
/// @throws InvalidInput, naming the vertex, for signs with which it does not fold; naming a crease, if several ways to
/// fold fit the known signs
SolvedSigns solve_signs(QuadMesh& mesh, const VertexName& name);

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
