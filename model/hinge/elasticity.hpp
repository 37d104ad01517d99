#pragma once

#include "model/hinge/hinge_law.hpp"

namespace kinetix::model {

/// What the hinges and walls of a structure are made of. The energy of a hinge (kinematics.md section 3) is
///
///     k_point (|dp|^2 + reach^2 |dd|^2) + 1/2 k_turn turn^2        (the last term by `law`)
///
/// with dp, dd the mismatch of hinge point and unit hinge axis as its two bodies carry them: that of two
/// springs of stiffness k_point at the hinge point +- reach along the axis, plus a turning spring that is
/// relaxed in the flat state. The same numbers describe the hinge in the physics run.
struct Elasticity {
  double k_point = 1000;                                 ///< of each of the two points, N/mm
  double k_turn = 0.1;                                   ///< N mm/rad
  double reach_mm = 1.8;                                 ///< half distance of the two points, mm
  double k_contact = 1e4;                                ///< of two walls pressed into each other, N/mm
  std::shared_ptr<const HingeLaw> law = linear_hinge();  ///< of the turn, by k_turn; not null

  /// All are positive, from 1e-30 to 1e30: their ratios and products stay numbers.
  /// @throws InvalidInput, naming the field, its value and its range
  void validate() const;
};

/// The same over k_point and the cell edge: energies come in units of k_point edge^2, forces of k_point edge.
struct Stiffness {
  double turn = 1e-6;   ///< k_turn, in units of k_point edge^2
  double reach = 0.18;  ///< cell edges; 0: axes are parallel whatever the bodies do
  double contact = 10;  ///< k_contact, in units of k_point
  std::shared_ptr<const HingeLaw> law = linear_hinge();
};

/// The stiffnesses as ratios, for a cell edge in mm.
Stiffness relative(const Elasticity& elasticity, double edge_mm);
/// k_point edge^2, N mm.
double energy_unit(const Elasticity& elasticity, double edge_mm);

}  // namespace kinetix::model
