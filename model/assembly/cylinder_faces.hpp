#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Facets of a solid that lie on one round cylinder.
struct CylinderFace {
  bool hollow = false;      ///< a bore; else the outside of a rod
  Eigen::Vector3d point;    ///< on the axis, mm
  Eigen::Vector3d axis;     ///< unit vector; its largest component is positive
  double radius_mm = 0;     ///< of the circle through the corners of its facets, mm
  double inner_mm = 0;      ///< distance of the middle of its facets from the axis, mm
  double from = 0, to = 0;  ///< along the axis, of axis . p, mm
  double turn = 0;          ///< that the facets go round, rad, (0, 2 pi]
};

/// All of at least six facets that go round by more than 200 degrees: what less does not hold a rod. Facets are neighbours across an
/// edge along the axis at which the surface turns by up to 35 degrees: circles drawn with 12 sides and more.
std::vector<CylinderFace> cylinder_faces(const Polyhedron& solid);

/// A rod of one body in the bore of another.
struct PinFit {
  Eigen::Vector3d point;    ///< on the axis, in the middle of where they overlap along it, mm
  Eigen::Vector3d axis;     ///< unit vector
  double rod_mm = 0;        ///< diameter, mm
  double clearance_mm = 0;  ///< a side: of the bore's facets from the rod's corners, mm
  double length_mm = 0;     ///< of the overlap along the axis, mm
};

/// Whether they turn about one axis: axes parallel to 1 degree and nearer than the clearance, the rod thinner than the bore by at
/// most half its radius, both beside each other along the axis by at least a quarter of the rod's diameter.
std::optional<PinFit> pin_fit(const CylinderFace& rod, const CylinderFace& bore);

}  // namespace kinetix::model
