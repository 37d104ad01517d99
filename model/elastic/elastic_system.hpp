#pragma once

#include "model/elastic/contact/contact_energy.hpp"
#include "model/elastic/contact/piece_contact.hpp"
#include "model/elastic/cord_element.hpp"
#include "model/elastic/tangent_stiffness.hpp"
#include "model/hinge/hinge_energy.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Structure of rigid bodies with elastic hinges under a drive, and its energy. The energy is that of all
/// hinges, of all contacts and of the springs of a shape-memory drive. For a driven hinge or a tendon, a term
/// enforces the turn or the shortening of the drive (method of multipliers). Energies are in units of k_point
/// edge^2. Gradients are by the bodies' twists as in model/closure/closure.hpp.
class ElasticSystem {
 public:
  /// @param planar bodies move in the plane z = 0 only.
  /// @param bodies with contact: bodies that touch instead of walls; null: the walls.
  /// @pre elasticity and drive are valid.
  /// @throws InvalidInput if the elasticity has neither one stiffness for all hinges nor one for each. With
  ///   contact, also if walls overlap in the flat state
  ElasticSystem(Linkage structure, const Elasticity& elasticity, LinkageDrive drive, bool planar,
                bool contact, const std::shared_ptr<const ConvexBodies>& bodies = {});
  /// Constructs a system without a drive: theta has no meaning, and rigid motion is held at one body.
  ElasticSystem(Linkage structure, const Elasticity& elasticity, bool planar, bool contact,
                const std::shared_ptr<const ConvexBodies>& bodies = {})
      : ElasticSystem(std::move(structure), elasticity, LinkageDrive(), planar, contact, bodies) {}

  const Linkage& structure() const { return structure_; }
  const Stiffness& stiffness() const { return stiffness_; }
  const LinkageDrive& drive() const { return drive_; }
  const DofMap& dofs() const { return dofs_; }
  const std::vector<RestHinge>& hinges() const { return structure_.hinges; }
  const ContactModel& walls() const { return walls_; }
  bool has_contact() const { return contact_; }
  /// Bodies that the plates grip, first and last row; empty for other drives.
  const GrippedRows& gripped() const { return drive_.gripped; }

  /// Returns the contacts of walls.
  std::vector<Contact> contacts(const State& state) const;
  /// Returns the number of points of walls or bodies that are pressed into others.
  int touching(const State& state) const;
  /// Describes the first two that touch: "walls A and B touch"; empty if none do.
  std::string describe_touching(const State& state) const;
  /// Returns the kind of object in contact: "walls" or "bodies".
  std::string touching_kind() const { return pieces_ ? "bodies" : "walls"; }
  /// Returns whether walls or bodies passed through each other between two states
  /// (ContactSearch::passed_through, sweep_through; PieceContact::passed_through).
  bool passed_through(const State& before, const State& after) const;
  /// Returns whether walls cross that did not cross before (ContactSearch::newly_cross); always false for
  /// bodies.
  bool newly_cross(const State& before, const State& after) const;

  /// Moves the gripped bodies to their position at fold parameter theta of the drive.
  void place(double theta, State& state) const;
  /// Returns the state after a step along screws (model/closure/closure.hpp). Held or driven coordinates move
  /// along a straight line, since an arc would take them off their plate.
  State retract(const State& state, const Eigen::VectorXd& twists) const;
  /// Returns the length of a step from the linearised state: the largest turn of a body (rad) or first-order
  /// change of a hinge's gap (cell edges). Shifts that add up along a chain do not count.
  double length(const State& state, const Eigen::VectorXd& twists) const;
  /// Returns the derivative of the gripped coordinates by theta: all coordinates, cell edges; zero for other
  /// drives.
  Eigen::VectorXd place_rate(double theta) const;

  double energy(const State& state, double theta) const;
  /// Returns the energy of the hinges and contacts.
  double elastic_energy(const State& state) const;
  /// Returns the energy of the springs of a shape-memory drive; 0 for other drives.
  double spring_energy(const State& state, double theta) const;
  /// Returns elastic plus spring energy. The drive's load is its derivative.
  double stored_energy(const State& state, double theta) const;
  /// Returns the gradient of elastic_energy() by all coordinates.
  Eigen::VectorXd elastic_gradient(const State& state) const;
  /// Returns the gradient of energy() by all coordinates.
  Eigen::VectorXd gradient(const State& state, double theta) const;
  /// Computes the Hessian of energy() into `tangent`. @return the gradient
  Eigen::VectorXd linearise(const State& state, double theta, TangentStiffness& tangent) const;

  /// Returns whether the drive prescribes a coordinate of the state: the turn of a hinge, rad, or the
  /// shortening of a tendon, cell edges.
  bool holds_coordinate() const { return drive_.holds_coordinate(); }
  /// Returns that coordinate minus the drive's; 0 for drives without one.
  double drive_miss(const State& state, double theta) const;
  /// Returns the gradient of that coordinate by all coordinates of the bodies. @pre holds_coordinate()
  Eigen::VectorXd driven_gradient(const State& state) const;
  /// Returns the derivative of the prescribed coordinate by theta. @pre holds_coordinate()
  double driven_rate(double theta) const;
  /// Returns the turn of a driven hinge as an element.
  Element driven_turn(const State& state) const;
  /// Returns, for shape memory, the derivative of the load by all coordinates. It equals the derivative of
  /// the gradient by the drive's coordinate.
  Eigen::VectorXd spring_gradient(const State& state) const;
  /// Returns, for shape memory, the turn of a hinge at which its spring rests, rad.
  double spring_rest(int hinge, double theta) const;
  /// Returns, for shape memory, the stiffness of each spring, k_point edge^2.
  double k_spring() const { return k_spring_; }
  /// Adds the force of the present drive_miss() to the multiplier. @return whether the miss was above
  /// `tolerance`, rad
  bool update_multiplier(const State& state, double theta, double tolerance);
  double multiplier() const { return multiplier_; }
  void set_multiplier(double multiplier) { multiplier_ = multiplier; }
  /// Returns the derivative of the stored energy by the drive coordinate. For plates it is the compressive
  /// force, for a tendon the tension (k_point edge). For a driven hinge it is the moment, for springs the sum
  /// of the moments that fold their hinges (k_point edge^2).
  double load(const State& state, double theta) const;
  /// Index of the driven hinge; -1 for other drives.
  int driven_hinge() const { return drive_.hinge; }

  /// k_point edge^2: penalty stiffness of a driven hinge (per rad) or tendon (per cell edge); the multiplier
  /// supplies the rest of the force.
  static constexpr double grip = 100;

 private:
  std::vector<PieceTouch> touches(const State& state) const;
  template <class Visit>
  void visit_contacts(const State& state, const Visit& visit) const;
  /// Calls `visit` with the elements of a driven hinge or of springs.
  template <class Visit>
  void visit_drive(const State& state, double theta, const Visit& visit) const;
  bool is_cord() const { return drive_.only_pulls(); }
  /// Returns the index of the axis of plates: 0 or 1.
  int axis() const { return component(drive_.axis); }
  /// Returns the rest position along the axis of the row that plate 0 or 1 grips, cell edges.
  double row(int plate) const { return structure_.bodies[drive_.gripped[plate].front()].position[axis()]; }
  double turn_at(double theta) const { return turn_at_theta(drive_.sense, theta); }
  /// Returns the sense of the hinge's lower body.
  int sense_of(int hinge) const { return structure_.bodies[structure_.hinges[hinge].lower].sense; }
  RelativeTurn turn_of(int hinge, const State& state) const;
  double spring_load(const State& state, double theta) const;
  /// Returns the constraint element of a tendon, by the coordinates of its bodies.
  CordElement held_cord(const State& state, double theta) const;
  void add_to(Eigen::VectorXd& sum, const CordElement& cord) const;

  const Linkage structure_;
  Stiffness stiffness_;
  const LinkageDrive drive_;
  bool contact_;
  DofMap dofs_;
  mutable ContactModel walls_;                  ///< caches nearby walls; results do not depend on the cache
  mutable std::optional<PieceContact> pieces_;  ///< bodies instead of walls; also a cache
  double multiplier_ = 0;
  double k_spring_ = 0;   ///< k_point edge^2
  double cord_rest_ = 0;  ///< length of the tendon in the flat state, cell edges
};

}  // namespace kinetix::model
