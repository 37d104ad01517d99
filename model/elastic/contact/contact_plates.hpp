#pragma once

#include <cmath>

#include "model/hinge/element.hpp"
#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// Signed distance n . m - offset of a point on one body from a face of another body, in cell edges.
struct PointGap {
  Eigen::Vector3d n;  ///< outward normal, turned with its body
  Eigen::Vector3d a;  ///< from the point's body to the point
  Eigen::Vector3d m;  ///< from the face's body to the point
  double value = 0;

  /// Returns the gradient by the twists of both bodies, first that of the point, ordered as in Element.
  Vector12 gradient() const {
    Vector12 g;
    g << a.cross(n), n, n.cross(m), -n;
    return g;
  }

  Matrix12 hessian() const {
    const Eigen::Matrix3d cross_n = cross_matrix(n), turns = -cross_n * cross_matrix(a);
    Matrix12 h = Matrix12::Zero();
    h.block<3, 3>(0, 0) = turning_hessian(n, a);
    h.block<3, 3>(6, 6) = turning_hessian(m, n);
    h.block<3, 3>(6, 3) = cross_n;
    h.block<3, 3>(3, 6) = -cross_n;
    h.block<3, 3>(6, 9) = -cross_n;
    h.block<3, 3>(9, 6) = cross_n;
    h.block<3, 3>(6, 0) = turns;
    h.block<3, 3>(0, 6) = turns.transpose();
    return h;
  }

  /// Returns the change of gradient() if n, a and m change.
  Vector12 gradient_change(const Eigen::Vector3d& dn, const Eigen::Vector3d& da,
                           const Eigen::Vector3d& dm) const {
    Vector12 g;
    g << da.cross(n) + a.cross(dn), dn, dn.cross(m) + n.cross(dm), -dn;
    return g;
  }

  /// Returns 1/2 k value^2 with its derivatives.
  Element pressed(double k) const {
    const Vector12 by_twists = gradient();
    Element e;
    e.energy = 0.5 * k * value * value;
    e.gradient = k * value * by_twists;
    e.hessian = k * (by_twists * by_twists.transpose() + value * hessian());
    return e;
  }
};

/// Faces of a half wall's box through which a point may be pushed out.
enum class Face { side_plus, side_minus, wall_tip_end, top, bottom };

/// Point of every half wall that may enter the boxes of others.
struct ContactPoint {
  double part = 1;              ///< fraction of the half wall's length from the vertex; 1: at the wall tip
  double across = 0, high = 0;  ///< from the half wall's middle line along its normal and up, cell edges
};

/// Half wall in its body's frame, cell edges: a box from the vertex to the wall tip. Its end is cut along the
/// hinge axis, as in half_walls(). Fields *_rate are derivatives by beta of its hinge, per rad.
struct ContactPlate {
  int body = 0;
  Eigen::Vector3d edge, up, normal;  ///< unit; edge points from the vertex to the wall tip
  Eigen::Vector3d up_rate, normal_rate;
  double sign = 1;  ///< d(length)/dt, 1 or -1
  double length = 0;
  double slant = 0;       ///< Plate::slant
  double slant_rate = 0;  ///< its derivative by alpha of its hinge, per rad

  /// Length from the vertex to the tip at a height above the middle, at least 0, and its derivative by
  /// `length`.
  double length_at(double high) const { return std::max(0.0, length + slant * high); }
  double length_rate_at(double high) const { return length + slant * high > 0 ? 1 : 0; }
  /// Returns the distance of an inside point from the plane of the tip. @param along, high position from the
  /// vertex
  double to_end(double along, double high) const { return (length + slant * high - along) / end_slope(); }
  /// Returns the length along the edge per distance from the plane of the tip.
  double end_slope() const { return std::hypot(1, slant); }
  Eigen::Vector3d face_normal(Face face) const;  ///< outward
  Eigen::Vector3d face_normal_rate(Face face) const;
  /// Returns the derivative of face_normal() by alpha, per rad.
  Eigen::Vector3d face_normal_alpha_rate(Face face) const;
  /// Position of a point in the body's frame, cell edges, and its derivatives by `length`, alpha and beta.
  Eigen::Vector3d place(const ContactPoint& point) const;
  Eigen::Vector3d place_length_rate(const ContactPoint& point) const;
  Eigen::Vector3d place_alpha_rate(const ContactPoint& point) const;
  Eigen::Vector3d place_rate(const ContactPoint& point) const;
};

/// All half walls, in the order of half_walls().
struct ContactPlates {
  std::vector<ContactPlate> plates;
  std::vector<ContactPoint> points;                         ///< of each plate, those of the wall tip first
  double edge_mm = 0, half_thickness = 0, half_height = 0;  ///< mm; cell edges
  bool planar = false;

  /// Returns the largest distance of a wall tip's points from its middle, cell edges.
  double wall_tip_radius() const;
  /// Returns how much longer a slanted tip is at its rim than in its middle, cell edges.
  double slant_length(const ContactPlate& plate) const { return std::abs(plate.slant) * half_height; }
  /// Returns an upper bound of the distance of a half wall's points from its vertex, cell edges.
  double reach() const;
  /// Returns the distance of a face's plane from the vertex along its normal, cell edges.
  double face_offset(const ContactPlate& plate, Face face) const;
  /// Derivatives of face_offset() by the length of the plate and by alpha of its hinge.
  static double face_offset_rate(const ContactPlate& plate, Face face) {
    return face == Face::wall_tip_end ? 1 / plate.end_slope() : 0;
  }
  static double face_offset_alpha_rate(const ContactPlate& plate, Face face) {
    const double slope = plate.end_slope();
    return face == Face::wall_tip_end
               ? -plate.length * plate.slant * plate.slant_rate / (slope * slope * slope)
               : 0;
  }
};

/// Computes the contact plates of a structure.
///
/// Planar: one point per wall tip corner, at the height of the neutral plane. In space: three points per wall
/// tip edge, and others along top and bottom, at most a thickness apart. So an edge that crosses another wall
/// has a point inside it. For walls thinner than an eightieth of their length, edges can cross between two
/// points.
/// @param planar bodies move in the plane only
ContactPlates contact_plates(const Linkage& structure, bool planar);

}  // namespace kinetix::model
