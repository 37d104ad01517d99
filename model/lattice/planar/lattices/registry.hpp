#pragma once

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// The regular lattices that files may name, in the order of the documentation. (Squares are a kind of their
/// own, model/lattice/square: they alone have families that leave the plane.)
const std::vector<const PlanarLattice*>& planar_lattices();

/// One more from now on. @param lattice lives as long as the program
void add_planar_lattice(const PlanarLattice& lattice);

}  // namespace kinetix::model
