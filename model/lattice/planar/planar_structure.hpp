#pragma once

#include <vector>

#include "model/lattice/planar/planar_lattice.hpp"
#include "model/linkage/hinge_parameters.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/wall.hpp"

namespace kinetix::model {

/// A structure of rigid walls on any planar graph whose faces are even (kinematics.md section 5): one body
/// for each vertex, one hinge for each edge, a cell for each bounded face.
struct PlanarStructure {
  CellSize size;  ///< edge_mm: the unit of the graph's coordinates
  PlanarGraph graph;
  std::vector<GraphFace> faces;
  std::vector<int> senses;              ///< +1 (class A) or -1, of each vertex
  std::vector<HingeParameters> hinges;  ///< of each edge
  LatticeSheet drawn = {};  ///< its first faces are these cells, in their order; no lattice: drawn by hand

  operator Linkage() const;
};

/// All hinges basic. @throws InvalidInput for what validate and senses refuse, and sizes that are not
/// positive
PlanarStructure make_planar_structure(PlanarGraph graph, const CellSize& size);
/// @throws InvalidInput likewise, and for cells that are given twice or do not hang together by walls
PlanarStructure make_planar_structure(LatticeSheet sheet, const CellSize& size);

/// From the first vertex of its edge.
HingedWall hinged_wall(const PlanarStructure& structure, int hinge);

/// @throws InvalidInput, naming wall and value, for hinge parameters outside their ranges (NaN included)
void validate_hinges(const PlanarStructure& structure);

}  // namespace kinetix::model
