#pragma once

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// Returns the regular lattices that files may name, in the order of the documentation. (Squares are separate,
/// model/lattice/square: only they have families that leave the plane.)
const std::vector<const PlanarLattice*>& planar_lattices();

/// Adds a lattice. @param lattice must live as long as the program
void add_planar_lattice(const PlanarLattice& lattice);

}  // namespace kinetix::model
