#pragma once

#include "model/cell_opening.hpp"

namespace kinetix {

/// A channel of one cell with its derivatives.
struct CellReading {
  double value = 0;
  /// Column b: by the twist of the cell's body b in the plane: turn (rad), shift along x and y (cell edges).
  Eigen::Matrix<double, 3, 4> bodies = Eigen::Matrix<double, 3, 4>::Zero();
  /// By t of its four hinges, where the bodies stay.
  std::array<double, 4> t = {};
};

/// A smooth stand-in for aperture(): the least distance to the walls becomes the soft minimum
/// -log(sum exp(-s d)) / s with s = `sharpness` per cell edge, so that the value is at most 2 log(8) / s
/// smaller. Its largest circle is found by Newton's method from the middle of the cell and from half-way to its
/// hinges: smooth, but for where two pockets of an opening are equally wide. NaN where the cell has none.
CellReading soft_aperture(const Opening& opening, double sharpness = 80);

/// area() with its derivatives.
CellReading area_reading(const Opening& opening);

}  // namespace kinetix
