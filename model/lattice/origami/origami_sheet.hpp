#pragma once

#include "model/lattice/origami/quad_mesh.hpp"
#include "model/lattice/planar/planar_structure.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// Positions of a sheet's bodies on its mesh.
struct OrigamiLayout {
  /// Radius of the circle of the four bodies about an inner vertex, as a ratio to its shortest crease, (0, 0.36].
  /// Above it, hinges of neighbouring vertices would be too near each other.
  double radius = 0.36;
  double rim = 0.75;  ///< hinge position on creases that end at the boundary: fraction from inside, (0, 1)

  /// @throws InvalidInput
  void validate() const;
};

/// A mesh as a sheet of walls (kinematics.md section 6), with 2 x 2 bodies per facet joined by upright hinges. Walls
/// across a crease are perpendicular to it and halved by it. Their hinges lean by the crease's tilt, tan(beta) = its
/// multiplier. The sheet has one degree of freedom: it shrinks by cos(theta), and every crease folds with tan(rho /
/// 2) = c sin(theta).
struct OrigamiSheet {
  PlanarStructure structure;
  QuadMesh mesh;                          ///< in the cell edges of the structure: the mean wall has length 1
  std::vector<std::array<int, 2>> facet;  ///< column and row of the facet of each body
};

/// Returns the interval of psi, the angle from the level crease to the body next to it, at an inner vertex. In it the
/// four bodies, mirror images across all four creases, are in order. The wall across each crease crosses the crease
/// itself, if sectors are within about 50 to 130 deg. For more uneven sectors, a wall crosses the extension of a crease
/// beyond the vertex. {0, 0} if no walls fit. @param a, b sectors, rad
std::array<double, 2> psi_interval(double a, double b);

/// Creates the sheet of a mesh. @param size edge_mm is the length of a mean wall, mm.
/// @throws InvalidInput as validate() of a mesh, for a vertex without room for its bodies (named), and for walls that
/// would cross
OrigamiSheet origami_sheet(const QuadMesh& mesh, const CellSize& size, const OrigamiLayout& layout = {});

/// Returns the exact state at theta, mm, body by body from the frames of the facets; facet (0, 0) stays flat.
State fold(const OrigamiSheet& sheet, double theta);

}  // namespace kinetix::model
