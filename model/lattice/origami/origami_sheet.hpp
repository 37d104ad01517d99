#pragma once

#include <array>
#include <vector>

#include "model/lattice/origami/quad_mesh.hpp"
#include "model/lattice/planar/planar_structure.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// Where the bodies of a sheet stand on its mesh.
struct OrigamiLayout {
  /// Radius of the circle about an inner vertex on which its four bodies stand, as a ratio to its shortest crease, (0, 0.36]:
  /// beyond, hinges of neighbouring vertices would come too near each other.
  double radius = 0.36;
  double rim =
      0.75;  ///< where hinges cross creases that end at the rim: fraction of them from inside, (0, 1)

  /// @throws InvalidInput
  void validate() const;
};

/// A mesh as a sheet of walls (kinematics.md section 6): 2 x 2 bodies a facet, joined by upright hinges; walls across a
/// crease are perpendicular to it and halved by it, their hinges lean by the crease's tilt, tan(beta) = its multiplier.
/// One degree of freedom: the sheet shrinks by cos(theta), and every crease folds with tan(rho / 2) = c sin(theta).
struct OrigamiSheet {
  PlanarStructure structure;
  QuadMesh mesh;                          ///< in the cell edges of the structure: its mean wall has length 1
  std::vector<std::array<int, 2>> facet;  ///< column and row of the facet of each body
};

/// The angle psi from the level crease to the body beside it, of each inner vertex: the interval in which the four
/// bodies, mirror images across all four creases, stand in order. Empty (first > second) for sectors that are too
/// uneven, outside some 50 to 130 deg. @param a, b sectors, rad
std::array<double, 2> psi_interval(double a, double b);

/// @param edge_mm the length of a mean wall; thickness and height of walls, mm, beside it
/// @throws InvalidInput as validate() of a mesh, naming the vertex round which no bodies can stand, and for walls that
/// would cross
OrigamiSheet origami_sheet(const QuadMesh& mesh, const CellSize& size, const OrigamiLayout& layout = {});

/// Its exact state at theta, mm, body by body from the frames of the facets; facet (0, 0) stays flat.
State fold(const OrigamiSheet& sheet, double theta);

}  // namespace kinetix::model
