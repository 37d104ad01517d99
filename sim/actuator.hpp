#pragma once

#include <memory>
#include <vector>

#include "model/linkage/linkage_drive.hpp"

class btGeneric6DofSpring2Constraint;
class btRigidBody;

namespace kinetix::sim {

class Cord;
class ElasticHinges;

/// A drive in the engine: its joints, and what moves them.
class Actuator {
 public:
  virtual ~Actuator() = default;
  virtual std::vector<btGeneric6DofSpring2Constraint*> joints() const = 0;
  /// @param theta of the drive, with sign, rad
  virtual void move_to(double theta) = 0;
  /// Distance from where it should be: cell edges for plates, rad for a hinge; NaN if a body's place is. Of plates
  /// that press how far a body lies behind its plate.
  virtual double gap() const = 0;
};

/// @param bodies in the structure's order; they must outlive the actuator
/// @param error_reduction part of a gap removed per step, (0, 1]
/// @param elastic null for rigid hinges; else a driven hinge is driven through them, and they must outlive
/// the actuator, as must the structure
/// @param spring_weight shape memory: of each spring over the stiffness of a hinge point, as Stiffness::turn
/// @param cord that of a drive that pulls one; must outlive the actuator
/// @pre shape memory has elastic hinges
std::unique_ptr<Actuator> make_actuator(const model::Linkage& structure, const model::LinkageDrive& drive,
                                        const std::vector<std::unique_ptr<btRigidBody>>& bodies,
                                        double error_reduction, ElasticHinges* elastic = nullptr,
                                        double spring_weight = 0, Cord* cord = nullptr);

}  // namespace kinetix::sim
