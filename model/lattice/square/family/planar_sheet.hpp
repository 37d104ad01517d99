#pragma once

#include <string>

#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Returns a sheet of squares as a structure on a planar graph. Its vertices are the bodies and its edges are the
/// hinges, in the same order. Its faces are the cells, in the same order, then the holes between them.
PlanarStructure planar_structure(const Structure& sheet);

/// Planar motion of a sheet (kinematics.md section 5).
struct PlanarSheet {
  Redrawing y;      ///< per body, if it moves exactly; otherwise empty
  int hinge = -1;   ///< if it does not move exactly: one around the face with the worst misfit
  std::string why;  ///< one sentence
};

/// Computes the planar motion of a sheet. @pre all hinges are upright
PlanarSheet planar_motion(const Structure& sheet);

/// Places the hinges of a sheet by y, given for each body; alpha and beta do not change.
void place_hinges(const Redrawing& y, Structure& sheet);

/// Returns the state at theta, mm. @param y per body
State fold(const Redrawing& y, const Structure& sheet, double theta);

}  // namespace kinetix::model
