#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// Vector to the next cell of a row, and half of the vector to the second row above (odd rows may be shifted), cell
/// edges.
struct LatticePitch {
  Eigen::Vector2d column, row;
};
/// @param angle rad, for lattices with an angle
LatticePitch lattice_pitch(const PlanarLattice& lattice, double angle);

/// Returns the box around columns x rows cells, cell edges.
Eigen::AlignedBox2d lattice_box(const PlanarLattice& lattice, int columns, int rows, double angle);

/// Returns cells whose middle is in a region, from a rectangle of columns x rows and a few cells around it. Only the
/// largest piece that is connected by walls is returned. It is moved to start at [0, 0] (rows by an even number), row
/// by row. Empty if no cell is in the region.
/// @param inside predicate in cell edges
std::vector<LatticeCell> cut_cells(const PlanarLattice& lattice, int columns, int rows, double angle,
                                   const std::function<bool(const Eigen::Vector2d& middle)>& inside);

}  // namespace kinetix::model
