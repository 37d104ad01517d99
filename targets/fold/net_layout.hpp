#pragma once

#include <vector>

#include "targets/fold/fold_net.hpp"

namespace kinetix::targets {

/// A face on the lattice: its cells are [i, i + width) x [j, j + height), its bodies the vertices up to both
/// ends.
struct PlacedFace {
  int i = 0, j = 0, width = 0, height = 0;
};

/// The bending cells between two faces.
struct PlacedCrease {
  model::Axis axis = model::Axis::x;  ///< of the walls that tilt: x where the faces lie side by side along x
  int i = 0, j = 0;                   ///< lowest cell
  int columns = 1;                    ///< cells along the axis
  int length = 1;                     ///< cells along the fold line
};

/// A net's faces and creases on the lattice.
struct NetLayout {
  std::vector<PlacedFace> faces;      ///< as in the net
  std::vector<PlacedCrease> creases;  ///< likewise
  std::vector<model::Cell> cells;     ///< of all faces and creases, sorted, none negative
};

/// Places the faces one after the other along the creases, with each crease's columns between its faces.
/// @param columns of each crease, >= 1
/// @throws InvalidInput, naming faces or creases: a crease between faces that do not lie beside each other,
/// faces that overlap or touch without a crease, creases that need one cell to bend both ways, and a ring of
/// faces with folds in both directions
/// @pre validate accepts the net
NetLayout lay_out(const FoldNet& net, const std::vector<int>& columns);

/// Walls along the crease's axis in its cells: those that tilt to bend it.
std::vector<model::Wall> bending_walls(const PlacedCrease& crease);

/// Bodies of a face in a structure, row by row: vertex (i, j) at (j - face.j) * (width + 1) + i - face.i.
std::vector<int> face_bodies(const PlacedFace& face, const model::Structure& structure);
/// The one nearest to the face's middle.
int middle_body(const PlacedFace& face, const model::Structure& structure);

}  // namespace kinetix::targets
