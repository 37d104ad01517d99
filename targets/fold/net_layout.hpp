#pragma once

#include <vector>

#include "targets/fold/fold_net.hpp"

namespace kinetix::targets {

/// The bending cells between two faces.
struct PlacedCrease {
  model::Axis axis = model::Axis::x;  ///< of the walls that tilt: x where the faces lie side by side along x
  model::CellRectangle cells;         ///< the fold lines run across the axis

  int columns() const { return cells.extent(axis); }  ///< cells along the axis
};

/// A net's faces and creases on the lattice.
struct NetLayout {
  std::vector<model::CellRectangle> faces;  ///< as in the net
  std::vector<PlacedCrease> creases;        ///< as in the net
  std::vector<model::Cell> cells;           ///< of all faces and creases, sorted, none negative
};

/// Places the faces one after the other along the creases, with each crease's columns between its faces.
/// @param columns of each crease, >= 1.
/// @throws InvalidInput, naming faces or creases, for a crease between faces that are not next to each other. Faces
/// that overlap or touch without a crease also throw, as do creases that need one cell to bend both ways. A ring of
/// faces with folds in both directions throws too.
/// @pre validate accepts the net
NetLayout lay_out(const FoldNet& net, const std::vector<int>& columns);

/// Returns the walls along the crease's axis in its cells, which tilt to bend it.
std::vector<model::Wall> bending_walls(const PlacedCrease& crease);

}  // namespace kinetix::targets
