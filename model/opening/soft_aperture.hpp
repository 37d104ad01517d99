#pragma once

#include "model/opening/cell_opening.hpp"

namespace kinetix::model {

/// A channel of one cell with its derivatives.
struct CellReading {
  double value = 0;  ///< over the cell edge (aperture) or its square (area)
  /// Column b: by the twist of the cell's body b in the plane: turn (rad), shift along x and y (cell edges).
  Eigen::Matrix3Xd bodies;
  /// By t of its hinges (fractions of the wall), where the bodies stay.
  std::vector<double> t;

  explicit CellReading(std::size_t walls) : bodies(Eigen::Matrix3Xd::Zero(3, walls)), t(walls) {}
};

/// A smooth stand-in for aperture(): the least distance to the outline becomes the soft minimum
/// -log(sum w exp(-s d)) / s with s = `sharpness` per cell edge over the half walls, w = 1, and the gaps,
/// w = 1 - exp(-(s g)^2) of a gap of length g: smooth where a hinge is closed, and then as without it. So the
/// value is at most 2 log(12) / s smaller in a cell of four walls. Its largest circle is found by Newton's
/// method from the middle of the cell and from half-way to its hinges: smooth, but for where two pockets of
/// an opening are equally wide. NaN where the cell has none.
CellReading soft_aperture(const Opening& opening, double sharpness = 80);

/// area(), over the edge squared, with its derivatives.
CellReading area_reading(const Opening& opening);

}  // namespace kinetix::model
