#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/elastic/contact/contact_energy.hpp"
#include "model/elastic/contact/piece_contact.hpp"
#include "model/elastic/cord_element.hpp"
#include "model/elastic/tangent_stiffness.hpp"
#include "model/hinge/hinge_energy.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// A structure of rigid bodies with elastic hinges under a drive, and its energy: that of all hinges, of all
/// contacts, that of the springs of a shape-memory drive, and for a driven hinge or a cord the term that holds its turn or
/// its shortening at the drive's (method of multipliers).
/// Energies are in units of k_point edge^2, gradients by the bodies' twists as in model/closure/closure.hpp.
class ElasticSystem {
 public:
  /// @param planar bodies move in the plane z = 0 only   @pre elasticity and drive are valid
  /// @throws InvalidInput for an elasticity with neither one stiffness for all hinges nor one for each, and, with
  /// contact, for walls that overlap in the flat state
  /// @param bodies with contact: what presses on each other in place of walls; null: the walls
  ElasticSystem(Linkage structure, const Elasticity& elasticity, LinkageDrive drive, bool planar,
                bool contact, const std::shared_ptr<const ConvexBodies>& bodies = {});
  /// One that nothing drives: theta has no meaning, and rigid motion is held at one body.
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
  /// Bodies that the plates grip, first and last row; empty for any other drive.
  const GrippedRows& gripped() const { return drive_.gripped; }

  /// Of walls.
  std::vector<Contact> contacts(const State& state) const;
  /// How many points of walls or bodies are pressed into others.
  int touching(const State& state) const;
  /// The first two that touch, in words: "walls A and B touch"; empty where none do.
  std::string touching_words(const State& state) const;
  /// What presses on each other: "walls" or "bodies".
  std::string what_touches() const { return pieces_ ? "bodies" : "walls"; }
  /// Whether walls or bodies went through each other between two states (ContactSearch::passed_through, sweep_through;
  /// PieceContact::passed_through).
  bool passed_through(const State& before, const State& after) const;
  /// Whether walls cross each other that did not before (ContactSearch::newly_cross); never where bodies take their place.
  bool newly_cross(const State& before, const State& after) const;

  /// Moves what plates grip to where fold parameter theta of the drive has them.
  void place(double theta, State& state) const;
  /// The state after a step along screws (model/elastic/retract.hpp). Coordinates that are held or driven go
  /// straight on: an arc would take them off their plate.
  State retract(const State& state, const Eigen::VectorXd& twists) const;
  /// How far a step leads from where derivatives were taken: largest turn of a body (rad) or first-order
  /// change of a hinge's gap (cell edges). Shifts that add up along a chain do not count.
  double length(const State& state, const Eigen::VectorXd& twists) const;
  /// How fast what plates grip moves by theta: all coordinates, cell edges; zero for any other drive.
  Eigen::VectorXd place_rate(double theta) const;

  double energy(const State& state, double theta) const;
  /// The energy of the hinges and contacts alone.
  double elastic_energy(const State& state) const;
  /// That of the springs of a shape-memory drive; 0 for any other.
  double spring_energy(const State& state, double theta) const;
  /// Both: what the drive's load is the derivative of.
  double stored_energy(const State& state, double theta) const;
  /// Its gradient by all coordinates.
  Eigen::VectorXd elastic_gradient(const State& state) const;
  /// Of energy(), by all coordinates.
  Eigen::VectorXd gradient(const State& state, double theta) const;
  /// The same with the Hessian.
  Eigen::VectorXd linearise(const State& state, double theta, TangentStiffness& tangent) const;

  /// Whether the drive holds a coordinate of the state: the turn of a hinge, rad, or the shortening of a cord, cell edges.
  bool holds_coordinate() const { return drive_.holds_coordinate(); }
  /// That coordinate less the drive's; 0 for drives that hold none.
  double drive_miss(const State& state, double theta) const;
  /// Its gradient by all coordinates of the bodies. @pre holds_coordinate()
  Eigen::VectorXd driven_gradient(const State& state) const;
  /// How fast it is driven, by theta. @pre holds_coordinate()
  double driven_rate(double theta) const;
  /// A driven hinge: element of its turn.
  Element driven_turn(const State& state) const;
  /// Shape memory: derivative of the load by all coordinates, which is that of the gradient by the drive's coordinate.
  Eigen::VectorXd spring_gradient(const State& state) const;
  /// Shape memory: turn of a hinge at which its spring rests, rad.
  double spring_rest(int hinge, double theta) const;
  /// Shape memory: stiffness of each spring, k_point edge^2.
  double k_spring() const { return k_spring_; }
  /// Takes over the force that the miss has called up. @return whether that was more than `tolerance`, rad
  bool update_multiplier(const State& state, double theta, double tolerance);
  double multiplier() const { return multiplier_; }
  void set_multiplier(double multiplier) { multiplier_ = multiplier; }
  /// Stored energy by drive coordinate: compressing force of the plates, or tension of the cord (k_point edge); moment about
  /// the driven hinge, or the sum of the moments by which springs turn their hinges on (k_point edge^2).
  double load(const State& state, double theta) const;
  /// Index of the driven hinge; -1 for any other drive.
  int driven_hinge() const { return drive_.hinge; }

  /// k_point edge^2, holds a driven hinge (by rad) or cord (by cell edges): the multiplier does the rest.
  static constexpr double grip = 100;

 private:
  std::vector<PieceTouch> touches(const State& state) const;
  template <class Visit>
  void visit_contacts(const State& state, const Visit& visit) const;
  /// The elements of a driven hinge, which hold it, or of springs.
  template <class Visit>
  void visit_drive(const State& state, double theta, const Visit& visit) const;
  bool is_cord() const { return drive_.only_pulls(); }
  /// Along the axis: 0 or 1.
  int axis() const { return component(drive_.axis); }
  /// Place along the axis at rest of the bodies that plate 0 or 1 grips, cell edges.
  double row(int plate) const { return structure_.bodies[drive_.gripped[plate].front()].position[axis()]; }
  double turn_at(double theta) const { return turn_at_theta(drive_.sense, theta); }
  /// Of its lower body.
  int sense_of(int hinge) const { return structure_.bodies[structure_.hinges[hinge].lower].sense; }
  RelativeTurn turn_of(int hinge, const State& state) const;
  double spring_load(const State& state, double theta) const;
  /// What holds a cord, by the coordinates of its bodies.
  CordElement held_cord(const State& state, double theta) const;
  void add_to(Eigen::VectorXd& sum, const CordElement& cord) const;

  const Linkage structure_;
  Stiffness stiffness_;
  const LinkageDrive drive_;
  bool contact_;
  DofMap dofs_;
  mutable ContactModel walls_;  ///< remembers which walls are near; what it finds does not depend on it
  mutable std::optional<PieceContact> pieces_;  ///< likewise, of bodies in place of walls
  double multiplier_ = 0;
  double k_spring_ = 0;   ///< k_point edge^2
  double cord_rest_ = 0;  ///< length of the cord in the flat state, cell edges
};

}  // namespace kinetix::model
