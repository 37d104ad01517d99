#pragma once

#include "app/goals/outline/outline_file.hpp"
#include "app/run/run_options.hpp"
#include "optim/outline/fit_outline.hpp"

namespace kinetix::app {

/// Result of an outline search.
struct FoundOutline {
  model::Lattice sheet;  ///< panel with its hinges and its size in mm
  optim::OutlineDesign design;
  int cuts = 0;     ///< number of cuts of the lattice that were tried; 0: the panel is a whole rectangle
  double turn = 0;  ///< rotation of the outline from the drawing to the panel, rad
};

/// Runs the search of a file. First it chooses the orientation of the outline on the lattice and the cut of the lattice
/// that are nearest to the outline. Then it fits hinges and theta.
///
/// The orientations to try follow from the shape of the outline (targets::direction_of). The panel therefore does not
/// depend on the orientation of the drawing. A disc keeps the orientation of the drawing.
/// @throws InvalidInput for a panel that its sizes do not allow
FoundOutline search_outline(const OutlineFile& file, const RunOptions& options);

/// First panel of a search, for the forecast.
struct OutlineStart {
  std::vector<model::LatticeCell> cells;  ///< cells of the first cut of the lattice
  double edge_mm = 0;                     ///< from the file, else from the areas of outline and panel
};
/// Returns the first panel of a search. @throws InvalidInput if no cells of the lattice are within the outline
OutlineStart outline_start(const OutlineFile& file);

}  // namespace kinetix::app
