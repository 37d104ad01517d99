#pragma once

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Opening of a cell in the plane of the flat sheet: the region between its half walls, two per wall. At a
/// stretched hinge both ends count, and a straight line closes the joint separation. Lengths are in cell
/// edges.
struct Opening {
  struct Side {
    Eigen::Vector2d vertex, wall_tip;  ///< neutral line of the half wall
    int body = 0;                      ///< index of the body in the cell that carries it
    int hinge = 0;                     ///< index of the hinge in the cell that ends it
    double sign = 1;  ///< d(length)/dt of the half wall, cell edges: 1 or -1 for walls of length 1
  };
  std::vector<Side> sides;  ///< counter-clockwise from the first vertex
  double half_thickness = 0;

  /// Returns the outline along the neutral lines and across the separations; each wall tip of a hinge is a
  /// corner.
  std::vector<Eigen::Vector2d> outline() const;
  bool contains(const Eigen::Vector2d& point) const;
  /// Returns the distance from a point to the nearest line of the outline, cell edges.
  double clearance(const Eigen::Vector2d& point) const;
};

Opening opening(const Linkage& structure, const State& state, const LinkageCell& cell);

/// Computes the channel `aperture`: diameter of the largest circle in an opening, minus the thickness of a
/// wall, over the cell edge. It is 0 if no circle fits. The method is subdivision of the plane (the pole of
/// inaccessibility), to `precision`, cell edges.
double aperture(const Opening& opening, double precision = 1e-6);

/// Computes the channel `area`: the area within the outline, over the edge squared.
double area(const Opening& opening);

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
