#pragma once

#include <string>

#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// A sheet of squares as a structure on a planar graph, whose vertices are the bodies and whose edges are the
/// hinges, in the same order. Its faces are the cells, in the same order, then the holes between them.
PlanarStructure planar_structure(const Structure& sheet);

/// The planar motion of a sheet (kinematics.md section 5).
struct PlanarSheet {
  Redrawing y;      ///< of each body, where it moves exactly; else empty
  int hinge = -1;   ///< where it does not: one on the rim of the face that closes worst
  std::string why;  ///< one sentence
};

/// @pre all hinges stand upright
PlanarSheet planar_motion(const Structure& sheet);

/// Puts the hinges of a sheet where y, of each body, has them; alpha and beta stay.
void place_hinges(const Redrawing& y, Structure& sheet);

/// State at theta, mm. @param y of each body
State fold(const Redrawing& y, const Structure& sheet, double theta);

}  // namespace kinetix::model
