#pragma once

#include <vector>

#include "model/base/angle.hpp"
#include "model/lattice/planar/planar_graph.hpp"
#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// The design parameters of a hinge on a wall of any direction e, from its first vertex to its second. The
/// defaults are the basic planar hinge.
struct WallHinge {
  double t = 0.5;         ///< fraction of the wall from its first vertex, in (0, 1)
  double alpha = pi / 2;  ///< angle of the hinge axis from e in the plane of the wall, rad, in (0, pi)
  double beta = 0;        ///< lean of the wall, rad, in (-pi/2, pi/2)
  double offset = 0;      ///< of the hinge point across the wall, towards z x e, cell edges
};

/// A structure of rigid walls on any planar graph whose faces are even (kinematics.md section 5): one body
/// for each vertex, one hinge for each edge, a cell for each bounded face.
struct PlanarStructure {
  CellSize size;  ///< edge_mm: the unit of the graph's coordinates
  PlanarGraph graph;
  std::vector<GraphFace> faces;
  std::vector<int> senses;        ///< +1 (class A) or -1, of each vertex
  std::vector<WallHinge> hinges;  ///< of each edge

  operator Linkage() const;
};

/// All hinges basic. @throws InvalidInput for what validate and senses refuse, and sizes that are not
/// positive
PlanarStructure make_planar_structure(PlanarGraph graph, const CellSize& size);

/// @throws InvalidInput, naming wall and value, for hinge parameters outside their ranges (NaN included)
void validate_hinges(const PlanarStructure& structure);

}  // namespace kinetix::model
