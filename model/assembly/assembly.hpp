#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/base/invalid_input.hpp"
#include "model/linkage/linkage.hpp"
#include "model/matter/made_hinge.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// A closed shell of a model of hard and soft parts, mm.
struct ModelPart {
  std::string name;
  bool soft = false;
  Polyhedron solid;
};

/// Parts of which none is soft, nor a rod in the bore of another.
class NoHinges : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// A rigid body of an assembly.
struct AssemblyBody {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< the center of its volume at rest, mm
  Polyhedron solid;                                    ///< at rest, mm
};

/// A hinge between two of its bodies.
struct AssemblyHinge {
  std::string name;
  int lower = 0, upper = 0;                         ///< bodies, lower < upper
  HingeKind kind = HingeKind::block;                ///< block: of a soft part; pin: a rod in a bore
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< mm
  Eigen::Vector3d axis =
      Eigen::Vector3d::UnitZ();  ///< unit vector; those of an assembly point to one side as far as they can
  Eigen::Vector3d along =
      Eigen::Vector3d::UnitX();  ///< unit vector, square to the axis, from the lower body to the upper one
  double confidence = 1;         ///< in the axis, 0 to 1
  double reach_mm = 1;           ///< half distance of the two points on the axis that hold it, > 0
  HingeStiffness k = {};
  double rod_mm = 0;        ///< diameter of a pin's rod
  double clearance_mm = 0;  ///< of a pin, a side
  Polyhedron soft = {};     ///< of a block: its part at rest, mm
  bool ball = false;        ///< holds its point alone and turns every way; kind and axis then say nothing
};

/// Rigid bodies of any shape and the hinges that join them, at rest: what an import finds in a model.
struct Assembly {
  double edge_mm =
      10;  ///< the length that plays the part of a cell edge: the median distance of two bodies that share a hinge
  std::vector<AssemblyBody> bodies;
  std::vector<AssemblyHinge> hinges;
  std::vector<std::string> notes = {};  ///< what its user should know
};

/// The median distance of two bodies that share a hinge, mm. @pre a hinge
double hinge_distance(const Assembly& assembly);
/// The first body that hangs on no chain of hinges with body 0; nothing where all do.
std::optional<int> first_apart(const Assembly& assembly);

/// What a person says of hinges that their shape leaves open.
struct HingeChoices {
  std::map<std::string, Eigen::Vector3d> axes = {};  ///< by the hinge's name, or "BODY/BODY"; unit vectors
  std::optional<Eigen::Vector3d> towards =
      {};  ///< unit vector; of ambiguous hinges: whichever of their two axes is nearer to it
  std::optional<Material> material = {};  ///< of soft parts; else tango
};

/// Bodies are the hard parts, a hinge is a soft part that touches two of them, or the rod of one in the bore of another.
/// @throws InvalidInput, naming part and reason: a part that is no solid, crosses itself or another hard one; a soft part that touches
/// another number of hard parts than two; an ambiguous axis that no choice settles; a choice of a hinge that is not there; no hinge at all; a
/// body that hangs on no hinge
Assembly make_assembly(const std::vector<ModelPart>& parts, const HingeChoices& choices = {});

/// Its hinges between the centers of its bodies, without plates and cells. Neighbours turn against each other, as
/// far as loops are even: that is the first motion that is looked for.
Linkage linkage_of(const Assembly& assembly);

}  // namespace kinetix::model
