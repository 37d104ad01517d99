#pragma once

#include <vector>

#include "model/lattice/planar/planar_lattice.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::optim {

/// Returns cuts of a lattice that resemble an outline when flat: the cells whose middle is inside it. The
/// outline fills the rectangle of columns x rows, is a little smaller or larger, and is shifted by half a
/// cell. Each cut is connected by walls and has at least four cells; no cut occurs twice. Columns and rows
/// are moved to start at 0 (rows by an even number, since odd ones may be shifted).
/// @param angle rad, of lattices with an angle
std::vector<std::vector<model::LatticeCell>> trimmed_cells(const model::PlanarLattice& lattice, double angle,
                                                           int columns, int rows,
                                                           const targets::Outline& outline);

}  // namespace kinetix::optim
