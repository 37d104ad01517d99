#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Where two solids touch: flat pieces of both surfaces that face each other.
struct ContactPatch {
  double area_mm2 = 0;                               ///< mm^2
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the area, mm
  Eigen::Vector3d normal = Eigen::Vector3d::
      Zero();  ///< mean of unit vectors by area, out of the first solid; shorter than 1 where the patch is curved
  std::vector<std::vector<Eigen::Vector3d>> pieces = {};  ///< convex polygons that make it up, mm
};

/// How near is touching.
struct ContactTolerance {
  double gap_mm = 0.05;  ///< between the two faces, or how deep they are in each other, mm, > 0
  double angle = 0.09;   ///< between the planes of the two faces, rad, > 0
};

/// The patch of `a` that touches `b`: every triangle of a, cut by every triangle of b that faces it. Exact for flat faces that
/// coincide; curved ones must have much the same triangles. Triangles of one solid do not overlap each other.
ContactPatch contact_patch(const Polyhedron& a, const Polyhedron& b, const ContactTolerance& tolerance = {});

}  // namespace kinetix::model
