#pragma once

#include <Eigen/Geometry>
#include <map>

#include "model/base/invalid_input.hpp"
#include "model/linkage/linkage.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Returns the component normal to the hinge's axis of the direction from one body to the other, as a unit vector.
/// Any normal direction is returned if they are aligned with the axis.
/// @param between from body to body, of any length   @param axis unit vector
inline Eigen::Vector3d direction_across(const Eigen::Vector3d& between, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d across = between - between.dot(axis) * axis;
  return across.norm() > 1e-6 * between.norm() ? Eigen::Vector3d(across.normalized())
                                               : Eigen::Vector3d(axis.unitOrthogonal());
}

/// A closed shell of a model of hard and soft parts, mm.
struct ModelPart {
  std::string name;
  bool soft = false;
  Polyhedron solid;
};

/// Error for parts without any soft part, and without rod, cone or ball in a bore, cup or socket of another.
class NoHinges : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// A rigid body of an assembly.
struct AssemblyBody {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< center of its volume at rest, mm
  Polyhedron solid;                                    ///< at rest, mm
};

/// A hinge between two bodies of an assembly.
struct AssemblyHinge {
  std::string name;
  int lower = 0, upper = 0;                         ///< bodies, lower < upper
  HingeKind kind = HingeKind::block;                ///< block: soft part; pin: rod in a bore
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< mm
  /// Axis as a unit vector; the axes of an assembly point to one side where possible
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  /// Direction as a unit vector, normal to the axis, from the lower body to the upper one
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  double confidence = 1;  ///< in the axis, 0 to 1
  double reach_mm = 1;    ///< half distance of the two points on the axis that support it, > 0
  HingeStiffness k = {};
  double rod_mm = 0;        ///< diameter of a pin's rod
  double clearance_mm = 0;  ///< clearance of a pin, per side
  Polyhedron soft = {};     ///< soft part of a block at rest, mm
  bool ball = false;  ///< holds only its point and turns in every direction; kind and axis are then unused
};

/// Rigid bodies of any shape and the hinges that join them, at rest: the result of an import.
struct Assembly {
  double edge_mm = 10;  ///< length used as the cell edge: hinge_distance()
  std::vector<AssemblyBody> bodies;
  std::vector<AssemblyHinge> hinges;
  std::vector<std::string> notes = {};  ///< remarks for the user
};

/// Returns the median distance of two bodies that share a hinge, mm. @pre a hinge
double hinge_distance(const Assembly& assembly);
/// Returns the first body without a chain of hinges to body 0; empty if all have one.
std::optional<int> first_apart(const Assembly& assembly);

/// Choices of the user for hinges that their shape leaves open.
struct HingeChoices {
  std::map<std::string, Eigen::Vector3d> axes = {};  ///< by the hinge's name, or "BODY/BODY"; unit vectors
  /// Direction (unit vector) that selects the nearer one of the two axes of ambiguous hinges
  std::optional<Eigen::Vector3d> towards = {};
  std::optional<Material> material = {};  ///< material of soft parts; default: tango
};

/// Creates an assembly. Bodies are the hard parts. A hinge is a soft part that touches two of them, or the rod of one
/// in the bore of another. Cones in cups, and two balls or bumps in sockets or dimples, are pins as well. One ball in a
/// socket that retains it is a spherical joint.
/// @throws InvalidInput, naming part and reason. Parts must be solids that cross neither themselves nor another hard
/// part. A soft part must touch exactly two hard parts. Each ambiguous axis needs a choice, and each choice an
/// existing hinge. There must be a hinge, and each body needs a chain of hinges to the others.
Assembly make_assembly(const std::vector<ModelPart>& parts, const HingeChoices& choices = {});

/// Creates a linkage of the hinges between the centers of the bodies, without plates and cells. Neighbours turn in
/// opposite directions as far as loops are even: this is the initial guess of the first motion.
Linkage linkage_of(const Assembly& assembly);

}  // namespace kinetix::model
