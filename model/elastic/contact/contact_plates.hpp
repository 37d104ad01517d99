#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// Faces of a half wall's box that a point may be pushed out through.
enum class Face { side_plus, side_minus, wall_tip_end, top, bottom };

/// A point of every half wall that may run into the boxes of others.
struct ContactPoint {
  double part = 1;              ///< fraction of the half wall's length, from the vertex; 1: at the wall tip
  double across = 0, high = 0;  ///< from the half wall's middle line along its normal and up, cell edges
};

/// A half wall in its body's frame, cell edges: a box from the vertex to the wall tip, its end cut along the hinge axis, as
/// half_walls() has it. *_rate are derivatives by beta of its hinge, per rad.
struct ContactPlate {
  int body = 0;
  Eigen::Vector3d edge, up, normal;  ///< unit; edge points from the vertex to the wall tip
  Eigen::Vector3d up_rate, normal_rate;
  double sign = 1;  ///< of d(length)/dt, 1 or -1
  double length = 0;
  double slant = 0;       ///< Plate::slant
  double slant_rate = 0;  ///< its derivative by alpha of its hinge, per rad

  /// Length from the vertex to the tip at a height above the middle, not below 0, and its derivative by `length`.
  double length_at(double high) const { return std::max(0.0, length + slant * high); }
  double length_rate_at(double high) const { return length + slant * high > 0 ? 1 : 0; }
  /// Distance of a point inside from the plane of the tip. @param along, high of the point from the vertex
  double to_end(double along, double high) const { return (length + slant * high - along) / end_slope(); }
  /// Length along the edge per distance from the plane of the tip.
  double end_slope() const { return std::hypot(1, slant); }
  Eigen::Vector3d face_normal(Face face) const;  ///< outward
  Eigen::Vector3d face_normal_rate(Face face) const;
  /// The derivative of face_normal() by alpha, per rad.
  Eigen::Vector3d face_normal_alpha_rate(Face face) const;
  /// In its body's frame, cell edges, and the derivatives by `length`, alpha and beta.
  Eigen::Vector3d place(const ContactPoint& point) const;
  Eigen::Vector3d place_length_rate(const ContactPoint& point) const;
  Eigen::Vector3d place_alpha_rate(const ContactPoint& point) const;
  Eigen::Vector3d place_rate(const ContactPoint& point) const;
};

/// All half walls, in the order of half_walls().
struct ContactPlates {
  std::vector<ContactPlate> plates;
  std::vector<ContactPoint> points;                         ///< of each, those of the wall tip first
  double edge_mm = 0, half_thickness = 0, half_height = 0;  ///< mm; cell edges
  bool planar = false;

  /// No point of a wall tip is further from its middle, cell edges.
  double wall_tip_radius() const;
  /// By how much a slanted tip is longer at its rim than in its middle, cell edges.
  double slant_length(const ContactPlate& plate) const { return std::abs(plate.slant) * half_height; }
  /// Nothing of a half wall is further from its vertex, cell edges.
  double reach() const;
  /// Of a face's plane from the vertex, along its normal, cell edges.
  double face_offset(const ContactPlate& plate, Face face) const;
  /// Its derivatives by the length of the plate and by alpha of its hinge.
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

/// @param planar one point a wall tip corner, at the height of the neutral plane. Else three along its edge, and
/// others along top and bottom, a thickness or less from each other, so that an edge which crosses another wall
/// has one inside it. Of walls thinner than an eightieth of their length, edges can cross between two points.
ContactPlates contact_plates(const Linkage& structure, bool planar);

}  // namespace kinetix::model
