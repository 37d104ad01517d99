#pragma once

#include "model/material/manufactured_hinge.hpp"
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

/// Axis about which a soft part between two rigid ones bends, computed from its shape.
///
/// The part is modelled as a beam from one contact patch to the other, along d. If the patches oppose each other, d
/// is the mean of their normals, otherwise the direction from center to center. Its cross-sections normal to d have
/// the bending inertias B(x), a 2 x 2 tensor, and
///
///     C = integral of B(x)^-1 dx
///
/// is its compliance to moments about the directions normal to d. The axis is the one with the largest compliance.
/// Its point is the mean of the sections' centers, weighted by their compliance. A waist attracts both.
struct SoftHinge {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< mm
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector; its largest component is positive
  /// Second axis as a unit vector: the next best axis, normal to `axis` and `along`
  Eigen::Vector3d other = Eigen::Vector3d::UnitX();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  ///< unit vector: d, from the first patch to the second
  /// Ratio, dimensionless: 1 - compliance about `other` / compliance about `axis`, 0 (a cube) to 1
  double confidence = 0;
  double length_mm = 0;   ///< length between the patches, > 0
  double height_mm = 0;   ///< height of the narrowest section along the axis
  double bending_mm = 0;  ///< thickness of the uniform block of equal bending compliance, mm
  double pulling_mm = 0;  ///< thickness of the uniform block of equal pull compliance, mm

  /// Returns true if the confidence is below min_confidence.
  bool is_ambiguous() const;
};

/// Confidence of a section less than 1.15 times as long as wide. Below it, errors of a print or a drawing decide the
/// axis.
inline constexpr double min_confidence = 0.25;

/// Computes the hinge of a soft part.
/// @param first, second contact patches with the two rigid parts, normals out of the soft one.
/// @return empty if the patches are at one place or no section between them has an area
std::optional<SoftHinge> soft_hinge(const Polyhedron& soft, const ContactPatch& first,
                                    const ContactPatch& second);

/// Returns the hinge with a given axis. @param axis not along `along`; made normal to it
SoftHinge turned_to(const SoftHinge& hinge, const Polyhedron& soft, const ContactPatch& first,
                    const ContactPatch& second, const Eigen::Vector3d& axis);

/// Returns the stiffness of the equivalent block: of thickness bending_mm in bending, and of thickness pulling_mm in
/// pull and shear.
HingeStiffness stiffness(const SoftHinge& hinge, const Material& material);
/// Returns half the distance of two points on the axis with the same support as its height, mm.
double reach_mm(const SoftHinge& hinge);

}  // namespace kinetix::model
