#pragma once

#include "model/lattice/planar/planar_graph.hpp"

namespace kinetix::model {

/// How many ways a structure on the graph moves in the plane beyond its rigid motions, by counting bodies and
/// hinges: 3 V - 2 E - 3. Less than it really moves where walls repeat each other, as in squares, which
/// WallDofs counts right.
int counted_dofs(const PlanarGraph& graph);

/// Cells along the rim that leave a floppy lattice one degree of freedom (kinematics.md section 5): a wall across
/// the mouth of a notch of three walls, a parallelogram into the corner of a notch of two, the sharpest ones
/// first; and where notches run out, a wall across cells of six and more walls, along the rim. All faces stay
/// even. As it was where it has one degree of freedom or less, and as far as it goes where nothing more can be added.
PlanarGraph closed_rim(PlanarGraph graph);

}  // namespace kinetix::model
