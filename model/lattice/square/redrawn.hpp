#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// The parameters of a hinge, carried to another wall across the same crease: tilts alternate along it, and so does
/// the end of the wall that t and alpha are counted from.
HingeParameters carried_to(const Wall& wall, const Hinge& hinge);

/// A sheet on other cells.
struct Redrawn {
  Structure structure;
  std::vector<std::optional<int>> from;  ///< by hinge: the one of the sheet before that it is like
};

/// The same design on other cells: walls that stay keep their hinges, new ones get those of their crease, and where
/// the sheet before has no such crease the middle, upright.
/// @throws InvalidInput where the cells are none, twice or not connected
Redrawn redrawn(const Structure& before, std::vector<Cell> cells, const CellSize& size);

/// Columns and rows that the cells reach over, counted from 0.
std::array<int, 2> extent(const Structure& structure);

/// The cells with that one, or without it.
std::vector<Cell> with_cell(const Structure& structure, Cell cell, bool present);

/// All cells of columns x rows, >= 1 each.
std::vector<Cell> full_sheet(std::array<int, 2> extent);

}  // namespace kinetix::model
