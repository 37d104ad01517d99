#pragma once

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Returns the parameters of a hinge for another wall across the same crease. Tilts alternate along the crease, and
/// so does the end of the wall from which t and alpha are measured.
HingeParameters carried_to(const Wall& wall, const Hinge& hinge);

/// A sheet with changed cells.
struct ChangedCells {
  Structure structure;
  std::vector<std::optional<int>> from;  ///< per hinge: the source hinge in the previous sheet
};

/// Returns the design on other cells. Walls that remain keep their hinges, new walls get the hinges of their crease.
/// Without such a crease in the previous sheet, hinges are in the middle and upright.
/// @throws InvalidInput if there are no cells, repeated cells or unconnected cells
ChangedCells with_changed_cells(const Structure& before, std::vector<Cell> cells, const CellSize& size);

/// Returns the numbers of columns and rows up to the last cells, counted from 0.
std::array<int, 2> extent(const Structure& structure);

/// Returns the cells with or without one cell.
std::vector<Cell> with_cell(const Structure& structure, Cell cell, bool present);

/// Returns all cells of columns x rows, >= 1 each.
std::vector<Cell> full_sheet(std::array<int, 2> extent);

}  // namespace kinetix::model
