#pragma once

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// Regular octagons with the squares between them (4.8.8).
extern const PlanarLattice octagon_lattice;

}  // namespace kinetix::model
