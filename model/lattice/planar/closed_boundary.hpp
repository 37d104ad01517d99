#pragma once

#include "model/lattice/planar/planar_graph.hpp"

namespace kinetix::model {

/// Degrees of freedom of a structure in the plane beyond rigid motions, updated wall by wall. A wall removes two
/// degrees of freedom of its vertices, unless they are removed already. Any structure of even faces keeps its exact
/// motion (kinematics.md section 5). Therefore at most 3 V - 4 degrees of freedom of any V vertices can be removed.
/// The count is the pebble game of Lee and Streinu (2008), with 3 pebbles per vertex and 4 that always stay.
class WallDofs {
 public:
  explicit WallDofs(const PlanarGraph& graph);

  void add_vertex();
  /// @return number of degrees of freedom that the wall removes: 2, 1 or 0
  int add_wall(const GraphEdge& wall);

  int count() const { return 3 * static_cast<int>(free_.size()) - 3 - held_; }

 private:
  bool hold(int a, int b);
  bool fetch(int to, int keep);

  std::vector<int> free_;                   ///< free pebbles of each vertex
  std::vector<std::vector<int>> leads_to_;  ///< far ends of each vertex's walls that hold its pebbles
  int held_ = 0;
};

/// Returns the degrees of freedom of a structure on the graph in the plane beyond rigid motions, by counting bodies
/// and hinges: 3 V - 2 E - 3. The count is too low if walls repeat each other, as in squares. WallDofs counts these
/// correctly.
int counted_dofs(const PlanarGraph& graph);

/// Adds cells along the boundary until an underconstrained lattice has one degree of freedom (kinematics.md section
/// 5). Notches of three walls are first, then the sharpest. A wall closes the mouth of a notch of three walls, a
/// parallelogram fills the corner of a notch of two. Without further notches, walls divide cells of six and more
/// walls, along the boundary first. All faces stay even. A graph with at most one degree of freedom is unchanged. The
/// process stops early if nothing more can be added.
PlanarGraph closed_boundary(PlanarGraph graph);

}  // namespace kinetix::model
