#pragma once

#include "model/linkage/state.hpp"
#include "targets/mesh/mesh_solid.hpp"

namespace kinetix::targets {

/// Walls of a folded structure that lie in a solid, wholly or in part.
struct WallsInside {
  std::vector<int> hinges;  ///< of these walls, ascending
  int corners = 0;      ///< of the two plates that make a wall (half_wall.hpp), eight each, that lie inside
  double depth_mm = 0;  ///< of the deepest corner; 0 where a solid pokes through a wall between its corners
};

/// @param state of the structure, in the frame of the solid
WallsInside walls_inside(const model::Linkage& structure, const model::State& state, const MeshSolid& solid);

}  // namespace kinetix::targets
