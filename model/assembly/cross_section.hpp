#pragma once

#include <Eigen/Core>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// A plane frame: u, v and the normal d are right-handed unit vectors.
struct PlaneFrame {
  Eigen::Vector3d u, v, d;

  /// u and v are any two square to d. @param d unit vector
  static PlaneFrame across(const Eigen::Vector3d& d);
};

/// Moments of the area in which a plane cuts a solid.
struct CrossSection {
  double area_mm2 = 0;                               ///< mm^2
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< in u and v, mm
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();  ///< integral of r r^T about the center, mm^4
  double edge_angle =
      0;  ///< mean direction of its edges modulo a quarter turn, by length, in u and v, rad, [0, pi/2)
  double edge_order = 0;  ///< how far they agree, dimensionless, 0 (a circle) to 1 (a rectangle)
};

/// By Green's theorem over the segments in which the plane d . p = at cuts the triangles: exact for the triangles as they are.
/// @param at mm   @pre closed
CrossSection cross_section(const Polyhedron& solid, const PlaneFrame& frame, double at);

}  // namespace kinetix::model
