#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "model/linkage/linkage_drive.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_result.hpp"

namespace kinetix::sim {

struct ContactParts;
struct TouchingPieces;
class Hand;
class RigidParts;

/// A structure as rigid parts, hinges and a drive in the engine. Half walls collide without friction, except
/// the two that share a hinge.
class World {
 public:
  /// @param drive nothing: none, and the structure floats freely
  /// @param parts what its bodies collide with; null: their walls
  World(const model::Linkage& structure, const std::optional<model::LinkageDrive>& drive,
        const PhysicsOptions& options, const ContactParts* parts = nullptr);
  ~World();

  /// Hands that pull and hold; needs the direct solver, as does the next.
  Hand& hand();
  /// From now on no part goes further in a step, cell edges or rad.
  void limit_way(double longest);
  RigidParts& parts();
  const RigidParts& parts() const;

  /// Elastic hinges: shifts the rest of their turning springs to where a motion from flat takes them.
  /// @param amount of the motion, by which its rates are multiplied
  void relax_along(const std::vector<model::Twist>& motion, double amount);
  /// @pre there is a drive: here, and for its gap
  /// Sets where the drive is to be at the end of the next step. @param theta rad, with sign
  void set_drive(double theta);
  /// Rotary hinges hold no sheet back that coasts: slows all parts alike until its cord is not slack at the end of the next step.
  /// Without a cord, or with elastic hinges, nothing.
  void slow_to_cord();
  void step();

  /// Largest force or moment (over the cell edge) that moved a part in the last step, which is what its
  /// hinges, drive and contacts left over; in units of the stiffness of a hinge point times the cell edge.
  /// NaN if one is NaN. @pre step was called
  double free_force() const;
  /// Whether what pressed in the last step is what had to: if not, its forces are none to trust. True before the first.
  bool contacts_agree() const;
  double drive_gap() const;
  PartContact deepest_contact() const;
  /// Pieces that pass through each other since they touched at rest.
  const std::vector<TouchingPieces>& touching_pieces() const;

  /// Largest middle Euler angle of the hinges' constraint frames, rad. It must stay away from pi/2.
  double largest_middle_angle() const;

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace kinetix::sim
