#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// The opening of a cell in the plane of the flat sheet: what is left between its half walls, two for each of
/// its walls, as they stand. At a stretched hinge both ends count, and the gap between them is closed by a
/// straight line. Lengths in cell edges.
struct Opening {
  struct Side {
    Eigen::Vector2d vertex, wall_tip;  ///< neutral line of the half wall
    int body = 0;                      ///< which of the cell's bodies carries it
    int hinge = 0;                     ///< which of its hinges ends it
    double sign = 1;                   ///< of d(length)/dt, 1 or -1
  };
  std::vector<Side> sides;  ///< counter-clockwise from the first vertex
  double half_thickness = 0;

  /// Its outline along the neutral lines and across the gaps; the two wall tips of a hinge are a corner each.
  std::vector<Eigen::Vector2d> outline() const;
  bool contains(const Eigen::Vector2d& point) const;
  /// From a point to the nearest line of the outline, cell edges.
  double clearance(const Eigen::Vector2d& point) const;
};

Opening opening(const Linkage& structure, const State& state, const LinkageCell& cell);

/// The channel `aperture`: diameter of the largest circle in an opening, less the thickness of a wall, over
/// the cell edge; 0 where no circle fits. By subdivision of the plane (the pole of inaccessibility), to
/// `precision`, cell edges.
double aperture(const Opening& opening, double precision = 1e-6);

/// The channel `area`: that within the outline, over the edge squared.
double area(const Opening& opening);

}  // namespace kinetix::model
