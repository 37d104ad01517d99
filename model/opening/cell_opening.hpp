#pragma once

#include <Eigen/Core>
#include <vector>

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

}  // namespace kinetix::model
