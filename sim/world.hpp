#pragma once

#include <memory>
#include <vector>

#include "model/drive.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_result.hpp"

namespace kinetix {

/// A structure as rigid parts, hinges and a drive in the engine. Units: cell edge 1, part mass 1, s.
///
/// The quasi-static answer depends on neither mass nor inertia, so those are chosen for the solver: equal
/// masses, the same inertia about every axis, centre of mass on the vertex. Half walls collide without
/// friction, except the two that share a hinge.
class World {
 public:
  World(const Structure& structure, const Drive& drive, const PhysicsOptions& options);
  ~World();

  /// Adds to the bodies' turning speeds what takes theta away from flat: +rate about z for class A, -rate for
  /// class B. @param rate rad/s
  void push(double rate);
  /// Adds a motion to the bodies' speeds. @param motion one twist per body, v in cell edges; @param rate 1/s
  void start(const std::vector<Twist>& motion, double rate);
  /// Elastic hinges: shifts the rest of their turning springs to where a motion from flat takes them.
  /// @param amount of the motion, by which its rates are multiplied
  void relax_along(const std::vector<Twist>& motion, double amount);
  /// Sets where the drive is to be at the end of the next step. @param theta rad, with sign
  void set_drive(double theta);
  void step();
  /// Multiplies all speeds. @param factor in [0, 1]
  void damp(double factor);

  State state() const;  ///< mm
  /// Largest speed or turning speed, edges/s or rad/s; NaN if one is NaN.
  double fastest_part() const;
  /// Largest turning speed of two parts that share a hinge against each other, rad/s; NaN if one is NaN.
  double fastest_hinge() const;
  double kinetic_energy() const;
  /// Largest force or moment (over the cell edge) that moved a part in the last step, which is what its
  /// hinges, drive and contacts left over; in units of the stiffness of a hinge point times the cell edge.
  /// NaN if one is NaN. @pre step was called
  double free_force() const;
  double drive_gap() const;
  PartContact deepest_contact() const;

  /// Largest middle Euler angle of the hinges' constraint frames, rad. It must stay away from pi/2.
  double largest_middle_angle() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace kinetix
