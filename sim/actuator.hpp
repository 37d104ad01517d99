#pragma once

#include <memory>

#include "model/linkage/linkage_drive.hpp"

class btGeneric6DofSpring2Constraint;
class btRigidBody;

namespace kinetix::sim {

class Cord;
class ElasticHinges;

/// Drive in the engine: its joints, and what moves them.
class Actuator {
 public:
  virtual ~Actuator() = default;
  virtual std::vector<btGeneric6DofSpring2Constraint*> joints() const = 0;
  /// Moves the drive. @param theta of the drive, with sign, rad
  virtual void move_to(double theta) = 0;
  /// Returns the distance from the target: cell edges for plates, rad for a hinge; NaN if the place of a body
  /// is NaN. For plates that press it is the distance of a body behind its plate.
  virtual double gap() const = 0;
};

/// Makes the drive of a structure.
/// @param bodies in the structure's order; they must outlive the actuator.
/// @param error_reduction fraction of a gap removed per step, (0, 1].
/// @param elastic null for rigid hinges. Otherwise a driven hinge is driven through them. They and the
/// structure must outlive the actuator.
/// @param spring_weight shape memory: stiffness of each spring over that of a hinge point, as
/// Stiffness::turn.
/// @param cord tendon of a drive that pulls one; must outlive the actuator.
/// @pre shape memory has elastic hinges
std::unique_ptr<Actuator> make_actuator(const model::Linkage& structure, const model::LinkageDrive& drive,
                                        const std::vector<std::unique_ptr<btRigidBody>>& bodies,
                                        double error_reduction, ElasticHinges* elastic = nullptr,
                                        double spring_weight = 0, Cord* cord = nullptr);

}  // namespace kinetix::sim
