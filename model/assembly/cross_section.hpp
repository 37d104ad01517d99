#pragma once

#include <Eigen/Core>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// A plane frame: u, v and the normal d are right-handed unit vectors.
struct PlaneFrame {
  Eigen::Vector3d u, v, d;

  /// Returns a frame with any two u and v normal to d. @param d unit vector
  static PlaneFrame across(const Eigen::Vector3d& d);
};

/// Moments of the area in which a plane cuts a solid.
struct CrossSection {
  double area_mm2 = 0;                               ///< mm^2
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< in u and v, mm
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();  ///< integral of r r^T about the center, mm^4
  /// Length-weighted mean direction of edges in u and v, modulo pi / 2, rad, [0, pi/2)
  double edge_angle = 0;
  /// Agreement of the edge directions, dimensionless, 0 (a circle) to 1 (a rectangle)
  double edge_order = 0;
};

/// Computes the moments by Green's theorem over the segments in which the plane d . p = at cuts the triangles: exact
/// for the triangles.
/// @param at mm   @pre closed
CrossSection cross_section(const Polyhedron& solid, const PlaneFrame& frame, double at);

}  // namespace kinetix::model
