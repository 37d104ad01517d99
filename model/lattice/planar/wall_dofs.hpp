#pragma once

#include <vector>

#include "model/lattice/planar/planar_graph.hpp"

namespace kinetix::model {

/// How many ways a structure moves in the plane beyond its rigid motions, wall by wall as it is built. A wall
/// holds two ways of its vertices, unless they are held already: since any structure of even faces keeps its
/// exact motion (kinematics.md section 5), V vertices can be held in 3 V - 4 ways and no more, whichever of the
/// structure's they are. Counted by the pebble game of Lee and Streinu (2008), with 3 pebbles a vertex and 4
/// that always stay.
class WallDofs {
 public:
  explicit WallDofs(const PlanarGraph& graph);

  void add_vertex();
  /// @return how many ways it holds that were free: 2, 1 or none
  int add_wall(const GraphEdge& wall);

  int count() const { return 3 * static_cast<int>(free_.size()) - 3 - held_; }

 private:
  bool hold(int a, int b);
  bool fetch(int to, int keep);

  std::vector<int> free_;  ///< pebbles that lie on a vertex
  std::vector<std::vector<int>>
      leads_to_;  ///< of a vertex, for each of its pebbles that lies on a wall: its far end
  int held_ = 0;
};

}  // namespace kinetix::model
