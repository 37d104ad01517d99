#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// Faces of a half wall's box that a point may be pushed out through.
enum class Face { side_plus, side_minus, wall_tip_end, top, bottom };

/// A point of a half wall that may run into other boxes, in its body's frame, cell edges.
struct ContactPoint {
  Eigen::Vector3d at;
  double part = 1;            ///< of the half wall's length, from the vertex; 1: at the wall tip
  Eigen::Vector3d beta_rate;  ///< derivative of `at` by beta of its hinge, per rad
};

/// A half wall as contact sees it, in its body's frame, cell edges: a box from the vertex to the wall tip, its end square to
/// the edge whatever alpha is, and its points. *_rate are derivatives by beta of its hinge, per rad.
struct ContactPlate {
  int body = 0;
  Eigen::Vector3d edge, up, normal;  ///< unit; edge points from the vertex to the wall tip
  Eigen::Vector3d up_rate, normal_rate;
  double sign = 1;  ///< of d(length)/dt, 1 or -1
  double length = 0;
  std::vector<ContactPoint> points;  ///< those of the wall tip first

  Eigen::Vector3d face_normal(Face face) const;  ///< outward
  Eigen::Vector3d face_normal_rate(Face face) const;
};

/// All half walls, in the order of half_walls().
struct ContactPlates {
  std::vector<ContactPlate> plates;
  double edge_mm = 0, half_thickness = 0, half_height = 0;  ///< mm; cell edges
  bool planar = false;

  int points_per_plate() const { return plates.empty() ? 0 : static_cast<int>(plates.front().points.size()); }
  /// No point of a wall tip is further from its middle, cell edges.
  double wall_tip_radius() const;
  /// Nothing of a half wall is further from its vertex, cell edges.
  double reach() const;
  /// Of a face's plane from the vertex, along its normal, cell edges.
  double face_offset(const ContactPlate& plate, Face face) const;
};

/// @param planar one point a wall tip corner, at the height of the neutral plane. Else three along its edge, and
/// others along top and bottom, a thickness or less from each other, so that an edge which crosses another wall
/// has one inside it. Of walls thinner than an eightieth of their length, edges can cross between two points.
ContactPlates contact_plates(const Linkage& structure, bool planar);

}  // namespace kinetix::model
