#pragma once

#include "model/lattice/planar/planar_lattice.hpp"
#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// A structure of rigid walls on any planar graph whose faces are even (kinematics.md section 5). It has a body per
/// vertex, a hinge per edge, and a cell per bounded face.
struct PlanarStructure {
  CellSize size;  ///< edge_mm: the unit of the graph's coordinates
  PlanarGraph graph;
  std::vector<GraphFace> faces;
  std::vector<int> senses;              ///< +1 (sublattice A) or -1, per vertex
  std::vector<HingeParameters> hinges;  ///< per edge
  LatticeSheet drawn = {};  ///< its first faces are these cells, in order; no lattice: drawn by hand

  operator Linkage() const;
};

/// Creates a structure with basic hinges. @throws InvalidInput as validate and senses, and for sizes that are not
/// positive
PlanarStructure make_planar_structure(PlanarGraph graph, const CellSize& size);
/// Creates a structure with basic hinges from cells of a lattice. It also rejects repeated cells and cells not
/// connected by walls.
/// @throws InvalidInput
PlanarStructure make_planar_structure(LatticeSheet sheet, const CellSize& size);

/// Returns the wall of a hinge from the first vertex of its edge.
HingedWall hinged_wall(const PlanarStructure& structure, int hinge);

/// Checks the hinge parameters. @throws InvalidInput, naming wall and value, for one outside its range (NaN included)
void validate_hinges(const PlanarStructure& structure);

}  // namespace kinetix::model
