#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// From a cell to the next of its row, and half of the way to the second row above it (odd rows may be shifted), cell edges.
struct LatticePitch {
  Eigen::Vector2d column, row;
};
/// @param angle rad, of lattices that take one
LatticePitch lattice_pitch(const PlanarLattice& lattice, double angle);

/// The box around columns x rows cells, cell edges.
Eigen::AlignedBox2d lattice_box(const PlanarLattice& lattice, int columns, int rows, double angle);

/// The cells in a rectangle of columns x rows, and a few round it, whose middle lies in a region: of them the largest piece
/// that hangs together by walls, moved to start at [0, 0] (rows by an even number), row by row; none where none lies in it.
/// @param inside takes cell edges
std::vector<LatticeCell> cut_cells(const PlanarLattice& lattice, int columns, int rows, double angle,
                                   const std::function<bool(const Eigen::Vector2d& middle)>& inside);

}  // namespace kinetix::model
