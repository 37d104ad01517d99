#pragma once

#include <optional>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Facets of a solid that are on one round cylinder.
struct CylinderFace {
  bool hollow = false;      ///< true: a bore; false: the outside of a rod
  Eigen::Vector3d point;    ///< on the axis, mm
  Eigen::Vector3d axis;     ///< unit vector; its largest component is positive
  double radius_mm = 0;     ///< radius of the circle through the corners of its facets, mm
  double inner_mm = 0;      ///< distance of the middle of its facets from the axis, mm
  double from = 0, to = 0;  ///< range of axis . p, mm
  double turn = 0;          ///< angle covered by the facets, rad, (0, 2 pi]
};

/// Finds all cylinder faces with at least six facets and more than 200 degrees; a smaller angle does not retain a
/// rod. Neighbouring facets share an edge along the axis, where the surface turns by up to 35 degrees. Circles
/// therefore need 12 sides or more.
std::vector<CylinderFace> cylinder_faces(const Polyhedron& solid);

/// A rod of one body in the bore of another.
struct PinFit {
  Eigen::Vector3d point;    ///< on the axis, in the middle of the overlap along it, mm
  Eigen::Vector3d axis;     ///< unit vector
  double rod_mm = 0;        ///< diameter, mm
  double clearance_mm = 0;  ///< clearance per side, from the rod's corners to the bore's facets, mm
  double length_mm = 0;     ///< length of the overlap along the axis, mm
};

/// Returns the fit of a rod in a bore if they turn about one axis. Their axes are parallel to 1 degree and nearer
/// than the clearance. The clearance is at most half the rod's radius. Their overlap along the axis is at least a
/// quarter of the rod's diameter.
std::optional<PinFit> pin_fit(const CylinderFace& rod, const CylinderFace& bore);

}  // namespace kinetix::model
