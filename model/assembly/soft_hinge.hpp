#pragma once

#include <optional>
#include <string>

#include "model/assembly/contact_patch.hpp"
#include "model/matter/made_hinge.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// The axis about which a soft part between two rigid ones bends, found from its shape.
///
/// The part is taken as a beam from one contact patch to the other, along d: the mean of the patches' normals where these
/// oppose each other, else from center to center. Its cross-sections square to d have the bending inertias B(x), a 2 x 2 tensor, and
///
///     C = integral of B(x)^-1 dx
///
/// is how it yields to moments about the directions square to d. The axis is the one about which it yields most; its point the mean
/// of the sections' centers along the way, weighted by how much each yields. A waist draws both to itself.
struct SoftHinge {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< mm
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit vector; its largest component is positive
  Eigen::Vector3d other = Eigen::Vector3d::UnitX();  ///< unit vector: the next best axis, square to both
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  ///< unit vector: d, from the first patch to the second
  double confidence =
      0;  ///< dimensionless: 1 - how stiff it is about the axis over how stiff about the other one, 0 (a cube) to 1
  double length_mm = 0;   ///< between the patches, > 0
  double height_mm = 0;   ///< of the narrowest section along the axis
  double bending_mm = 0;  ///< thickness of the even block that yields as much when bent, mm
  double pulling_mm = 0;  ///< of the one that yields as much when pulled, mm

  /// Below least_confidence.
  bool is_ambiguous() const;
};

/// Where a section is less than 1.15 times as long as wide, the errors of a print or of the drawing decide which is which.
inline constexpr double least_confidence = 0.25;

/// @param first, second its patches with the two rigid parts, normals out of the soft one
/// @return nothing where the patches are at one place or no section between them has an area
std::optional<SoftHinge> soft_hinge(const Polyhedron& soft, const ContactPatch& first,
                                    const ContactPatch& second);

/// The same hinge with its axis set by hand. @param axis not along `along`; made square to it
SoftHinge turned_to(const SoftHinge& hinge, const Polyhedron& soft, const ContactPatch& first,
                    const ContactPatch& second, const Eigen::Vector3d& axis);

/// What it resists with: that of a block of the length, height and thickness that its sections come to, in bending by
/// bending_mm and in pull and shear by pulling_mm.
HingeStiffness stiffness(const SoftHinge& hinge, const Material& material);
/// Half distance of the two points on the axis that hold it as its height does, mm.
double reach_mm(const SoftHinge& hinge);

}  // namespace kinetix::model
