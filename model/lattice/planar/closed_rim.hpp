#pragma once

#include "model/lattice/planar/planar_graph.hpp"

namespace kinetix::model {

/// Returns the degrees of freedom of a structure on the graph in the plane beyond rigid motions, by counting bodies
/// and hinges: 3 V - 2 E - 3. The count is too low if walls repeat each other, as in squares. WallDofs counts these
/// correctly.
int counted_dofs(const PlanarGraph& graph);

/// Adds cells along the boundary until an underconstrained lattice has one degree of freedom (kinematics.md section
/// 5). Notches of three walls are first, then the sharpest. A wall closes the mouth of a notch of three walls, a
/// parallelogram fills the corner of a notch of two. Without further notches, walls divide cells of six and more
/// walls, along the boundary first. All faces stay even. A graph with at most one degree of freedom is unchanged. The
/// process stops early if nothing more can be added.
PlanarGraph closed_rim(PlanarGraph graph);

}  // namespace kinetix::model
