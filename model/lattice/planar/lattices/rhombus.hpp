#pragma once

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// Rhombi whose walls along the rows and across them enclose the angle.
extern const PlanarLattice rhombus_lattice;

/// Returns columns x rows squares, as rhombi of 90 deg.
PlanarGraph square_graph(int columns, int rows);

}  // namespace kinetix::model
