#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Contact area of two solids: flat pieces of both surfaces that face each other.
struct ContactPatch {
  double area_mm2 = 0;                               ///< mm^2
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< center of the area, mm
  /// Mean unit normal by area, out of the first solid; shorter than 1 for curved patches
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::vector<std::vector<Eigen::Vector3d>> pieces = {};  ///< convex polygons that form the patch, mm
};

/// Tolerances for faces in contact.
struct ContactTolerance {
  double gap_mm = 0.05;  ///< distance or overlap of the two faces, mm, > 0
  double angle = 0.09;   ///< angle between the planes of the two faces, rad, > 0
};

/// Returns the patch of `a` that touches `b`: every triangle of a, cut by every triangle of b that faces it. It is
/// exact for flat faces that coincide. Curved faces need nearly equal triangles. The triangles of a solid do not
/// overlap each other.
ContactPatch contact_patch(const Polyhedron& a, const Polyhedron& b, const ContactTolerance& tolerance = {});

}  // namespace kinetix::model
