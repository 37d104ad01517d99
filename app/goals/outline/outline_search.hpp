#pragma once

#include "app/goals/outline/outline_file.hpp"
#include "app/run/run_options.hpp"
#include "model/lattice/planar/planar_structure.hpp"
#include "optim/outline/fit_outline.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

using Cells = std::vector<model::LatticeCell>;

/// Returns the cell edge (mm) of the panel that these cells make: the file's, else an estimate from areas.
double edge_of(const OutlineFile& file, const Cells& cells);

/// Returns the possible cuts of the lattice along an outline, at least one. @throws InvalidInput if there is none
std::vector<Cells> cuts_of(const OutlineFile& file, const targets::Outline& folded);

/// Returns the cells whose middle is within a panel with larger cells, at rest.
/// @param ratio cell edges of that panel per cell edge of the file's
Cells cells_within(const OutlineFile& file, const model::PlanarStructure& coarse, double ratio);

/// Returns the angles (rad) that turn an outline onto the lattice, in steps of 45 deg from the outline's direction.
/// @param steps 4 if the panel has two-fold rotational symmetry, else 8
std::vector<double> turns_of(const targets::Outline& outline, int steps);

/// Returns the boundary of a panel at rest, scaled to the area of the outline and centred on it.
std::vector<Eigen::Vector2d> boundary_over(const targets::Outline& outline,
                                           const model::PlanarStructure& panel);

/// First panel of a search, for the forecast.
struct OutlineStart {
  Cells cells;         ///< cells of the first cut of the lattice
  double edge_mm = 0;  ///< from the file, else from the areas of outline and panel
};
/// Returns the first panel of a search. @throws InvalidInput if no cells of the lattice are within the outline
OutlineStart outline_start(const OutlineFile& file);

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

/// Returns how far an outline is from the goal, relative to the tolerances of its file: at most 1 if it is met.
double outline_excess(const OutlineFile& file, const targets::OutlineError& error);

/// Returns changes of its file that may bring a panel nearer to its outline: trimmed cells, more cells, and then other
/// lattices, few cells first.
std::vector<targets::DocumentChanges> outline_remedies(const OutlineFile& file,
                                                       const optim::OutlineDesign& missed);

}  // namespace kinetix::app
