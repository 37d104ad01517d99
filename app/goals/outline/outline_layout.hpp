#pragma once

#include "app/goals/outline/outline_file.hpp"
#include "model/lattice/planar/planar_structure.hpp"

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

}  // namespace kinetix::app
