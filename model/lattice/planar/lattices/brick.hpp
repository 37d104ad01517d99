#pragma once

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// The honeycomb drawn as a wall of bricks: 2 x 1 rectangles with a vertex in the middle of their long sides.
extern const PlanarLattice brick_lattice;

}  // namespace kinetix::model
