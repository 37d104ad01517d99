#pragma once

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// Regular hexagons with two walls of each upright; odd rows are shifted by half a hexagon.
extern const PlanarLattice honeycomb_lattice;

}  // namespace kinetix::model
