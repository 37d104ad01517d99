#pragma once

#include "model/lattice/square/structure.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Returns sizes that suit a cell edge: wall thickness a tenth of it and at most 3 mm, height three fifths of it and
/// at most 30 mm.
model::CellSize default_size(double edge_mm);

/// Cell edges that a file may give, mm: from a micrometre to the size of a hall.
inline constexpr targets::Bounds cell_edges = {0.001, 10'000, true, true, "mm"};

/// Returns a key of a `structure:` section. Its default depends on the kind of file.
targets::Key cells_key(targets::Default fallback, std::string meaning);
targets::Key cell_mm_key(targets::Default fallback, const targets::Bounds& bounds = cell_edges);
/// Returns the key `wall_mm`. @param thickness, height defaults in words
targets::Key wall_mm_key(const char* thickness = "a tenth of `cell_mm`, at most 3",
                         const char* height = "0.6 of `cell_mm`, at most 30");

/// Walls with none, one or both sizes given in a file. The others follow from the edge of a cell, or the mean length
/// of walls: 0.08 of it thick, 0.15 of it high. Thinner walls do not print. Thicker and higher ones run into each
/// other.
struct ThinWalls {
  std::optional<double> thickness_mm = {}, height_mm = {};

  model::CellSize size(double edge_mm) const;
};
/// Returns the key of thin walls. @param edge reference of their sizes, in words
targets::Key thin_walls_key(const std::string& edge, std::string meaning);

/// Reads the `cells:` key: [columns, rows], or a list of cells [i, j] with i and j from 0 to 9999.
/// @throws InvalidInput for anything else, a cell given twice, or more than a million cells
std::vector<model::Cell> read_cells(const targets::Node& cells);

/// Returns {columns, rows} if the cells fill a rectangle. @pre not empty, no cell twice
std::optional<std::array<int, 2>> as_rectangle(const std::vector<model::Cell>& cells);

/// Reads the `cell_mm:` and `wall_mm:` keys of a `structure:` section; default_size gives what is left out.
/// @param fallback_edge_mm cell edge if cell_mm is not given
/// @throws InvalidInput for lengths out of range, or a wall thicker than half the cell edge
model::CellSize read_size(const targets::Section& structure, double fallback_edge_mm);

/// Returns the length in mm that reads back as this number of cell edges, or the nearest if rounding leaves none.
double mm_of(double cells, double edge_mm);

}  // namespace kinetix::app
