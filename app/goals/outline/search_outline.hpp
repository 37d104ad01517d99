#pragma once

#include "app/goals/outline/outline_file.hpp"
#include "app/run/run_options.hpp"
#include "optim/outline/fit_outline.hpp"

namespace kinetix::app {

/// The panel that a search came to.
struct FoundOutline {
  model::Lattice sheet;  ///< with its hinges, and its size in mm
  optim::OutlineDesign design;
  int cuts = 0;     ///< of the lattice that were tried; 0: the panel is a whole rectangle
  double turn = 0;  ///< of the outline as it lies on the panel from where it was drawn, rad
};

/// The search that a file asks for: of the ways to lay the outline on the lattice, and of the cuts of the lattice that look like it
/// there, the one that comes nearest to it, then hinges and theta. The ways follow from the shape of the outline
/// (targets::direction_of), so that the panel does not depend on how it was drawn; a disc lies as it was drawn.
/// @throws InvalidInput for a panel that its sizes do not allow
FoundOutline search_outline(const OutlineFile& file, const RunOptions& options);

/// What a search begins with.
struct OutlineStart {
  std::vector<model::LatticeCell> cells;  ///< of the first way to cut the lattice
  double edge_mm = 0;                     ///< by the areas of outline and panel, where the file gives none
};
/// @throws InvalidInput where no cells of the lattice lie within the outline
OutlineStart outline_start(const OutlineFile& file);

}  // namespace kinetix::app
