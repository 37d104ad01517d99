#pragma once

#include <vector>

#include "model/elastic/contact/contact_energy.hpp"
#include "model/elastic/tangent_stiffness.hpp"
#include "model/hinge/hinge_energy.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// A structure of rigid bodies with elastic hinges under a drive, and its energy: that of all hinges, of all
/// contacts, and for a driven hinge the term that holds its turn at the drive's (method of multipliers).
/// Energies are in units of k_point edge^2, gradients by the bodies' twists as in model/closure/closure.hpp.
class ElasticSystem {
 public:
  /// @param planar bodies move in the plane z = 0 only   @pre elasticity and drive are valid
  /// @throws InvalidInput for an elasticity with neither one stiffness for all hinges nor one for each, and, with
  /// contact, for walls that overlap in the flat state
  ElasticSystem(Linkage structure, const Elasticity& elasticity, LinkageDrive drive, bool planar,
                bool contact);
  /// One that nothing drives: theta has no meaning, and rigid motion is held at one body.
  ElasticSystem(Linkage structure, const Elasticity& elasticity, bool planar, bool contact);

  const Linkage& structure() const { return structure_; }
  const Stiffness& stiffness() const { return stiffness_; }
  const LinkageDrive& drive() const { return drive_; }
  const DofMap& dofs() const { return dofs_; }
  const std::vector<RestHinge>& hinges() const { return structure_.hinges; }
  const ContactModel& walls() const { return walls_; }
  bool has_contact() const { return contact_; }
  /// Bodies that the plates grip, first and last row; empty for a driven hinge.
  const GrippedRows& gripped() const { return drive_.gripped; }

  std::vector<Contact> contacts(const State& state) const;
  /// Whether walls went through each other between two states (ContactModel::passed_through).
  bool passed_through(const State& before, const State& after) const;

  /// Moves what plates grip to where fold parameter theta of the drive has them.
  void place(double theta, State& state) const;
  /// The state after a step along screws (model/elastic/retract.hpp). Coordinates that are held or driven go
  /// straight on: an arc would take them off their plate.
  State retract(const State& state, const Eigen::VectorXd& twists) const;
  /// How far a step leads from where derivatives were taken: largest turn of a body (rad) or first-order
  /// change of a hinge's gap (cell edges). Shifts that add up along a chain do not count.
  double length(const State& state, const Eigen::VectorXd& twists) const;
  /// How fast what plates grip moves by theta: all coordinates, cell edges; zero for a driven hinge.
  Eigen::VectorXd place_rate(double theta) const;

  double energy(const State& state, double theta) const;
  /// The energy of the hinges and contacts alone.
  double elastic_energy(const State& state) const;
  /// Its gradient by all coordinates.
  Eigen::VectorXd elastic_gradient(const State& state) const;
  /// Of energy(), by all coordinates.
  Eigen::VectorXd gradient(const State& state, double theta) const;
  /// The same with the Hessian.
  Eigen::VectorXd linearise(const State& state, double theta, TangentStiffness& tangent) const;

  /// A driven hinge: its turn less the drive's, rad; 0 for plates.
  double drive_miss(const State& state, double theta) const;
  /// A driven hinge: element of its turn.
  Element driven_turn(const State& state) const;
  /// The gradient of its turn by all coordinates, rad by rad and by cell edges. @pre a hinge is driven
  Eigen::VectorXd driven_gradient(const State& state) const;
  /// Takes over the force that the miss has called up. @return whether that was more than `tolerance`, rad
  bool update_multiplier(const State& state, double theta, double tolerance);
  double multiplier() const { return multiplier_; }
  void set_multiplier(double multiplier) { multiplier_ = multiplier; }
  /// Energy by drive coordinate: compressing force of the plates (k_point edge), or moment about the driven
  /// hinge (k_point edge^2).
  double load(const State& state, double theta) const;
  /// The drive's own coordinate at theta: compression of the plates, or the turn of the hinge, rad.
  double drive_coordinate(double theta) const;
  /// What a unit of that coordinate is: the flat distance of the plates, mm; 1 rad.
  double travel() const;
  /// Its derivative by theta.
  double drive_rate(double theta) const;
  /// Index of the driven hinge; -1 for plates.
  int driven_hinge() const { return drive_.hinge; }

  static constexpr double grip = 100;  ///< k_point edge^2, holds a driven hinge: the multiplier does the rest

 private:
  template <class Visit>
  void visit_contacts(const State& state, const Visit& visit) const;
  /// The element that holds a driven hinge.
  template <class Visit>
  void visit_drive(const State& state, double theta, const Visit& visit) const;
  /// Along the axis: 0 or 1.
  int axis() const { return drive_.axis == Axis::x ? 0 : 1; }
  /// Place along the axis at rest of the bodies that plate 0 or 1 grips, cell edges.
  double row(int plate) const { return structure_.bodies[drive_.gripped[plate].front()].position[axis()]; }
  double turn_at(double theta) const { return turn_at_theta(drive_.sense, theta); }

  const Linkage structure_;
  Stiffness stiffness_;
  const LinkageDrive drive_;
  bool contact_;
  DofMap dofs_;
  mutable ContactModel walls_;  ///< remembers which walls are near; what it finds does not depend on it
  double multiplier_ = 0;
};

}  // namespace kinetix::model
