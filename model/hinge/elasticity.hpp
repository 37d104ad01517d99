#pragma once

#include <optional>
#include <vector>

#include "model/hinge/hinge_law.hpp"

namespace kinetix::model {

/// What a hinge resists with in its own frame: across its axis along the wall, across axis and wall, along its
/// axis, each of both its points together; to turning about its axis; and to tilting.
struct HingeStiffness {
  double axial = 2000;  ///< along the wall, N/mm
  double shear = 2000;  ///< across the wall and the axis, N/mm
  double along = 2000;  ///< along the axis, N/mm
  double turn = 0.1;    ///< about the axis, N mm/rad
  /// About the direction across wall and axis, and about the wall's own, N mm/rad. Nothing: as the reach holds
  /// them, axial reach^2 and shear reach^2.
  std::optional<double> rock = {}, twist = {};

  bool operator==(const HingeStiffness&) const = default;
};

/// The stiffnesses of a hinge against stretching over those of two springs k_point, 2 k_point.
struct PointRatios {
  double axial = 1;  ///< fields as in HingeStiffness
  double shear = 1;
  double along = 1;

  /// Whether the hinge is just those two springs.
  bool are_one() const { return axial == 1 && shear == 1 && along == 1; }
  bool operator==(const PointRatios&) const = default;
};

/// What a hinge resists tilting with where that does not follow from its reach, as in HingeStiffness.
struct TiltStiffness {
  std::optional<double> rock = {}, twist = {};  ///< N mm/rad; in Stiffness in units of k_point edge^2

  /// Whether the reach alone says it.
  bool are_by_reach() const { return !rock && !twist; }
  bool operator==(const TiltStiffness&) const = default;
};

/// What the hinges and walls of a structure are made of. The energy of a hinge (kinematics.md section 3) is
///
///     k_point (|dp|^2 + reach^2 |dd|^2) + 1/2 k_turn turn^2        (the last term by `law`)
///
/// with dp, dd the mismatch of hinge point and unit hinge axis as its two bodies carry them: that of two
/// springs of stiffness k_point at the hinge point +- reach along the axis, plus a turning spring that is
/// relaxed in the flat state. Where `ratios` are not 1, |g|^2 of dp and of dd is replaced by
///
///     shear |g|^2 + (axial - shear) (g . a)^2 + (along - shear) (g . c)^2
///
/// with a and c unit vectors half way between what the two bodies carry: a the direction of the wall made
/// perpendicular to the axis at rest, c the axis. They mean nothing where the bodies have turned against each
/// other by half a turn. Where `tilt` gives a stiffness of its own, the term of dd is
///
///     1/2 twist |dd|^2 + 1/2 (rock - twist) (dd . a)^2
///
/// with axial reach^2 or shear reach^2 for what it does not give. A hinge with play has another energy
/// (model/hinge/play_energy.hpp). The same numbers describe the hinge in the physics run.
struct Elasticity {
  double k_point = 1000;                                 ///< of each of the two points, N/mm
  double k_turn = 0.1;                                   ///< N mm/rad
  double reach_mm = 1.8;                                 ///< half distance of the two points, mm
  double k_contact = 1e4;                                ///< of two walls pressed into each other, N/mm
  std::shared_ptr<const HingeLaw> law = linear_hinge();  ///< of the turn, by k_turn; not null
  PointRatios ratios = {};                               ///< over 2 k_point
  TiltStiffness tilt = {};                               ///< N mm/rad
  double play_mm = 0;                                    ///< a side, in which neither point pulls
  /// By hinge, where not all are alike; else empty. Then this object's own k_point is the unit of energies,
  /// its k_contact that of all walls, and the rest of it is not used. Their own `each` are empty.
  std::vector<Elasticity> each = {};

  /// That of a hinge.
  const Elasticity& of(std::size_t hinge) const { return each.empty() ? *this : each[hinge]; }

  /// All but play are positive, from 1e-30 to 1e30: their ratios and products stay numbers. Play is from 0 to
  /// the reach; a hinge that has some resists alike along its wall and across it, and tilts by its reach.
  /// @throws InvalidInput, naming the field, its value and its range
  void validate() const;
};

/// The same over k_point and the cell edge: energies come in units of k_point edge^2, forces of k_point edge.
struct Stiffness {
  double turn = 1e-6;   ///< k_turn, in units of k_point edge^2
  double reach = 0.18;  ///< cell edges; 0: axes are parallel whatever the bodies do
  double contact = 10;  ///< k_contact, in units of k_point
  std::shared_ptr<const HingeLaw> law = linear_hinge();
  PointRatios ratios = {};
  TiltStiffness tilt = {};           ///< in units of k_point edge^2
  double play = 0;                   ///< cell edges
  std::vector<Stiffness> each = {};  ///< by hinge, where not all are alike, over the k_point of the whole

  /// Whether the hinge is more than two springs k_point.
  bool framed() const { return !ratios.are_one() || !tilt.are_by_reach() || play > 0; }
  /// Whether it resists tilting at all.
  bool tilts() const { return reach > 0 || !tilt.are_by_reach(); }
  /// What |dd|^2 counts with, and (dd . a)^2 besides: half of twist, and of rock less twist. k_point edge^2
  double twist_weight() const;
  double rock_beyond_twist() const;
  /// Without what bodies that stay parallel cannot feel: reach and tilt.
  void drop_tilt();

  /// That of a hinge; its contact is the whole's.
  const Stiffness& of(std::size_t hinge) const { return each.empty() ? *this : each[hinge]; }
  /// The least of all hinges.
  double least_turn() const;
  /// @throws InvalidInput unless there is one for all hinges, or one each
  void check_count(std::size_t hinges) const;
};

/// The stiffnesses as ratios, for a cell edge in mm.
Stiffness relative(const Elasticity& elasticity, double edge_mm);
/// A hinge by the stiffnesses of its own frame: k_point is half the largest of the first three, N/mm, and k_contact ten
/// times that.
Elasticity elasticity_of(const HingeStiffness& stiffness, double reach_mm);
/// The other way round; `each` does not count.
HingeStiffness stiffness_of(const Elasticity& elasticity);
/// k_point edge^2, N mm.
double energy_unit(const Elasticity& elasticity, double edge_mm);

}  // namespace kinetix::model
