#pragma once

#include "app/goals/outline/outline_layout.hpp"
#include "app/run/run_options.hpp"
#include "optim/outline/fit_outline.hpp"

namespace kinetix::app {

/// Result of an outline search.
struct FoundOutline {
  model::Lattice sheet;  ///< panel with its hinges and its size in mm
  optim::OutlineDesign design;
  int cuts = 0;     ///< number of cuts of the lattice that were tried; 0: the panel is a whole rectangle
  double turn = 0;  ///< rotation of the outline from the drawing to the panel, rad
  Cells cells;      ///< of the lattice that the panel is cut from
  int columns = 0, rows = 0;  ///< of the panel before it is trimmed
  double edge_mm = 0;         ///< cell edge
  double flat_turn = 0;       ///< rotation of the flat outline onto the panel, rad
};

/// Returns whether a design meets the goal of a file.
bool is_met(const OutlineFile& file, const optim::OutlineDesign& design);

/// Returns the same goal with another number of cells, of the same size in all. Lengths that the file gives for cells
/// grow or shrink with them. @param side the larger of columns and rows
OutlineFile with_cells(OutlineFile file, int side);

/// Runs the search of a file. First it chooses the orientation of the outline on the lattice and the cut of the lattice
/// that are nearest to the outline. Then it fits hinges and theta.
///
/// The orientations to try follow from the shape of the outline (targets::direction_of). The panel therefore does not
/// depend on the orientation of the drawing. A disc keeps the orientation of the drawing.
///
/// Panels with 8, 12, 16 and 20 columns or rows, if they are fewer than the file's, are fitted first. Each starts at
/// the shape of the one before it, too, and the better design counts. More cells are then seldom worse.
/// @throws InvalidInput for a panel that its sizes do not allow
FoundOutline search_outline(const OutlineFile& file, const RunOptions& options);
/// Runs the search without panels of fewer cells.
FoundOutline search_alone(const OutlineFile& file, const RunOptions& options);

}  // namespace kinetix::app
