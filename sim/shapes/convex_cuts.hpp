#pragma once

#include "model/solids/polyhedron.hpp"

namespace kinetix::sim {

/// Convex hull of the part of a solid inside one cell of space.
struct CutPiece {
  std::vector<Eigen::Vector3d> corners;  ///< mm
  Eigen::MatrixX4d faces;                ///< a row per face: unit normal outwards, and n . p on the face, mm
};

/// Round hole that may be filled, since its contents do not collide: the bore of a pin.
struct FilledBore {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on its axis, in the middle, mm
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector
  double radius_mm = 0;                             ///< radius within which pieces may protrude, mm
  double half_mm = 0;                               ///< half length to either side of the point along the
                                                    ///< axis, mm
};

struct CutOptions {
  /// Distance by which pieces may protrude from the solid, mm. 0: a hundredth of its longest side, at least
  /// 0.1 mm.
  double tolerance_mm = 0;
  int max_pieces = 32;  ///< >= 1
  std::vector<FilledBore> filled = {};
};

/// Covers a solid with convex pieces by recursive planar cuts.
///
/// A piece is the convex hull of the solid's part in a cell, which planes bound. Together the pieces cover
/// the whole solid for any cuts. Watch points are offset from its surface by 0.8 of the tolerance, at places
/// with no nearer surface. A cell whose hull contains no watch point is left unchanged. Of the others, the
/// one with the most is cut next, by a plane of a face below its watch points or perpendicular to one. The
/// plane is chosen that leaves the fewest points in both hulls. The cuts end when no cell has watch points,
/// or at the limit of pieces. The same solid gives the same pieces.
/// @pre closed, of one shell   @throws InvalidInput for options out of range
std::vector<CutPiece> convex_cuts(const model::Polyhedron& solid, const CutOptions& options = {});

}  // namespace kinetix::sim
