#pragma once

#include "model/opening/cell_opening.hpp"

namespace kinetix::model {

/// A channel of one cell with its derivatives.
struct CellReading {
  double value = 0;  ///< over the cell edge (aperture) or its square (area)
  /// Derivative by the twist of body b in the plane, in column b: turn (rad), shift along x and y (cell
  /// edges).
  Eigen::Matrix3Xd bodies;
  /// Derivatives by t of the cell's hinges (fractions of the wall), with the bodies fixed.
  std::vector<double> t;

  explicit CellReading(std::size_t walls) : bodies(Eigen::Matrix3Xd::Zero(3, walls)), t(walls) {}
};

/// Computes a smooth approximation of aperture(). The soft minimum -log(sum w exp(-s d)) / s replaces the
/// least distance to the outline, with s = `sharpness` per cell edge. Half walls have w = 1. A joint
/// separation of length g has w = 1 - exp(-(s g)^2): smooth at a closed hinge, where it has no effect.
/// The value is at most 2 log(12) / s smaller in a cell of four walls. The largest circle is found by
/// Newton's method from the middle of the cell and from half-way to its hinges. The result is smooth except
/// where two pockets of an opening are equally wide. It is NaN if the cell has no pocket.
CellReading soft_aperture(const Opening& opening, double sharpness = 80);

/// Computes area(), over the edge squared, with its derivatives.
CellReading area_reading(const Opening& opening);

}  // namespace kinetix::model
