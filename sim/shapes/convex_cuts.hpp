#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/solids/polyhedron.hpp"

namespace kinetix::sim {

/// A convex part of a solid: the hull of what of it lies in one cell of space.
struct CutPiece {
  std::vector<Eigen::Vector3d> corners;  ///< mm
  Eigen::MatrixX4d faces;                ///< a row each: unit normal outwards, and n . p on the face, mm
};

/// A round hole that may be filled, since what is in it does not collide: the bore of a pin.
struct FilledBore {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on its axis, in the middle, mm
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector
  double radius_mm = 0;                             ///< within which pieces may stick out, mm
  double half_mm = 0;                               ///< to either side of the point along the axis, mm
};

struct CutOptions {
  double tolerance_mm =
      0;  ///< by which pieces may stick out of the solid, mm; 0: a hundredth of its longest side, at least 0.1 mm
  int most_pieces = 32;  ///< >= 1
  std::vector<FilledBore> filled = {};
};

/// Convex pieces that cover a solid, by recursive planar cuts.
///
/// A piece is the convex hull of the solid's part in a cell, which planes bound: together pieces cover the whole solid, whatever the
/// cuts. Watch points are set off its surface by 0.8 of the tolerance, where nothing of it is nearer. A cell whose hull holds none of them is left as it
/// is; of the others, the one that holds most is cut next, by a plane of a face below its watch points or square to one, whichever leaves
/// the fewest in both hulls. It ends where none is left, or with as many pieces as are allowed.
/// The same solid gives the same pieces. @pre closed, of one shell   @throws InvalidInput for options out of range
std::vector<CutPiece> convex_cuts(const model::Polyhedron& solid, const CutOptions& options = {});

/// How good pieces are, by points in an even sequence over their box.
struct CutQuality {
  double coverage = 0;       ///< share of the points inside the solid that some piece holds
  double sticks_out_mm = 0;  ///< largest distance from the solid of a point that some piece holds, mm
  double overlap = 0;        ///< share of the points in pieces that several hold
};
/// @param points > 0, of the box
CutQuality measured(const std::vector<CutPiece>& pieces, const model::Polyhedron& solid, int points);

}  // namespace kinetix::sim
