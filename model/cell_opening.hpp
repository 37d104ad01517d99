#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/state.hpp"

namespace kinetix {

/// The opening of a cell in the plane of the flat sheet: what is left between its eight half walls. Lengths in
/// cell edges.
struct Opening {
  struct Side {
    Eigen::Vector2d vertex, knee;  ///< neutral line of the half wall
    int body = 0;                  ///< which of the cell's four bodies carries it
    int hinge = 0;                 ///< which of its four hinges ends it
    double sign = 1;               ///< of d(length)/dt
  };
  std::array<Side, 8> sides;  ///< counter-clockwise from the bottom-left vertex
  double half_thickness = 0;

  /// Its outline along the neutral lines; the two knees of a hinge are a corner each.
  std::vector<Eigen::Vector2d> outline() const;
  bool contains(const Eigen::Vector2d& point) const;
  /// From a point to the nearest neutral line.
  double clearance(const Eigen::Vector2d& point) const;
};

Opening opening(const Structure& structure, const State& state, const CellHinges& cell);

/// The channel `aperture`: diameter of the largest circle between the walls of an opening, over the cell edge; 0
/// where no circle fits. By subdivision of the plane (the pole of inaccessibility), to `precision`.
double aperture(const Opening& opening, double precision = 1e-6);

/// The channel `area`: that of the opening between its neutral lines, over the edge squared.
double area(const Opening& opening);

}  // namespace kinetix
