#pragma once

#include <vector>

#include "model/lattice/planar/planar_lattice.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::optim {

/// Cuts of a lattice that look like an outline already when flat: the cells whose middle lies inside it where it
/// fills the rectangle of columns x rows, a little smaller and larger, and shifted by half a cell. Each hangs
/// together by walls and holds at least four cells; none twice. Columns and rows are moved to start at 0 (rows by an
/// even number, since odd ones may be shifted).
/// @param angle rad, of lattices that take one
std::vector<std::vector<model::LatticeCell>> trimmed_cells(const model::PlanarLattice& lattice, double angle,
                                                           int columns, int rows,
                                                           const targets::Outline& outline);

}  // namespace kinetix::optim
