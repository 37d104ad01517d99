#pragma once

#include "model/linkage/linkage_drive.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_result.hpp"

namespace kinetix::sim {

struct ContactParts;
struct TouchingPieces;
class ExternalPulls;
class RigidParts;

/// Structure as rigid parts, hinges and a drive in the engine. Half walls collide without friction, except
/// the two that share a hinge.
class World {
 public:
  /// @param drive unset: no drive, and the structure floats freely.
  /// @param parts collision shapes of the bodies; null: their walls
  World(const model::Linkage& structure, const std::optional<model::LinkageDrive>& drive,
        const PhysicsOptions& options, const ContactParts* parts = nullptr);
  ~World();

  /// Returns the hands that pull and hold. They and limit_motion() need the direct solver.
  ExternalPulls& external_pulls();
  /// Limits the motion of every part per step, cell edges or rad.
  void limit_motion(double longest);
  RigidParts& parts();
  const RigidParts& parts() const;

  /// Elastic hinges: moves the rest angles of their turning springs to those of a motion from flat.
  /// @param amount of the motion, by which its rates are multiplied
  void relax_along(const std::vector<model::Twist>& motion, double amount);
  /// Sets the drive's target at the end of the next step. @pre there is a drive, as for its gap
  /// @param theta rad, with sign
  void set_drive(double theta);
  /// Slows all parts by one factor until the tendon is not slack at the end of the next step. Rigid hinges do
  /// not hold a coasting sheet back. Does nothing without a tendon or with elastic hinges.
  void slow_to_cord();
  void step();

  /// Returns the largest net force or moment (over the cell edge) that moved a part in the last step: the
  /// remainder of its hinges, drive and contacts. The unit is the stiffness of a hinge point times the cell
  /// edge. NaN if one is NaN. @pre step was called
  double free_force() const;
  /// Returns whether the rows that pushed in the last step were consistent. If not, its forces are
  /// meaningless. True before the first step.
  bool contacts_agree() const;
  double drive_gap() const;
  PartContact deepest_contact() const;
  /// Returns the pieces that pass through each other because they touched at rest.
  const std::vector<TouchingPieces>& touching_pieces() const;

  /// Returns the largest middle Euler angle of the hinges' constraint frames, rad. It must stay away from
  /// pi/2.
  double largest_middle_angle() const;

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace kinetix::sim
