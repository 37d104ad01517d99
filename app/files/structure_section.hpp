#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/lattice/square/structure.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Sizes that suit a cell edge: wall thickness a tenth of it and at most 3 mm, height three fifths of it
/// and at most 30 mm.
model::CellSize default_size(double edge_mm);

/// Cell edges that a file may give, mm: from a micrometre to a hall.
inline constexpr targets::Bounds cell_edges = {0.001, 10'000, true, true, "mm"};

/// Keys of a `structure:` section. What they default to depends on the kind of file.
targets::Key cells_key(targets::Default fallback, std::string meaning);
targets::Key cell_mm_key(targets::Default fallback, const targets::Bounds& bounds = cell_edges);
/// @param thickness, height what they default to, in words
targets::Key wall_mm_key(const char* thickness = "a tenth of `cell_mm`, at most 3",
                         const char* height = "0.6 of `cell_mm`, at most 30");

/// Walls of which a file gives none, one or both sizes; the others follow from the edge of a cell, or the length of a mean wall:
/// 0.08 of it thick, 0.15 of it high. Thinner ones do not print, thicker and higher ones run into each other.
struct ThinWalls {
  std::optional<double> thickness_mm = {}, height_mm = {};

  model::CellSize size(double edge_mm) const;
};
/// Their key. @param edge of what their sizes are a part, in words
targets::Key thin_walls_key(const std::string& edge, std::string meaning);

/// The `cells:` key: [columns, rows], or a list of cells [i, j] with i and j from 0 to 9999.
/// @throws InvalidInput for anything else, a cell given twice, or more than a million cells
std::vector<model::Cell> read_cells(const targets::Node& cells);

/// {columns, rows} where the cells fill a rectangle. @pre not empty, no cell twice
std::optional<std::array<int, 2>> as_rectangle(const std::vector<model::Cell>& cells);

/// The `cell_mm:` and `wall_mm:` keys of a `structure:` section; what is left out follows default_size.
/// @param fallback_edge_mm cell edge where cell_mm is not given
/// @throws InvalidInput for lengths out of range, or a wall thicker than half the cell edge
model::CellSize read_size(const targets::Section& structure, double fallback_edge_mm);

/// The length in mm that is read as this number of cell edges; the nearest where rounding leaves none.
double mm_of(double cells, double edge_mm);

}  // namespace kinetix::app
