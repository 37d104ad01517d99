#pragma once

#include <memory>
#include <optional>
#include <vector>

namespace kinetix::model {

/// Response of a hinge to a turn.
struct TurnResponse {
  double energy = 0;     ///< in the unit of k_turn
  double stiffness = 0;  ///< of its moment by the turn, in the unit of k_turn; 0 only if the moment is 0
  double stretch = 0;    ///< moment / stiffness, rad: the turn itself if the law is linear
  double energy_k = 0;   ///< derivative of the energy by k_turn, rad^2
  double moment_k = 0;   ///< derivative of the moment by k_turn, rad

  double moment() const { return stiffness * stretch; }  ///< in the unit of k_turn
};

/// Turning law of a hinge, the only description of it for the elastic model and the simulation. A custom law
/// derives from this class and is set in Elasticity::law. The response of the hinge point does not depend on
/// the law (Elasticity).
class HingeLaw {
 public:
  virtual ~HingeLaw() = default;
  /// @param turn from rest, rad, in [-pi, pi]   @param k_turn > 0, in any unit of energy
  virtual TurnResponse at(double turn, double k_turn) const = 0;
};

/// Law with the energy 1/2 k_turn turn^2.
class LinearHinge final : public HingeLaw {
 public:
  TurnResponse at(double turn, double k_turn) const override {
    return {0.5 * k_turn * turn * turn, k_turn, turn, 0.5 * turn * turn, turn};
  }
};

/// Law with the energy 1/2 k_turn (turn - set)^2: a hinge with a permanent set, such as plastic that was
/// heated while folded.
class SetHinge final : public HingeLaw {
 public:
  /// @param set turn at which it rests, rad, in [-pi, pi]
  explicit SetHinge(double set) : set_(set) {}
  TurnResponse at(double turn, double k_turn) const override;

 private:
  double set_;
};

/// Returns the shared LinearHinge, the default law of an Elasticity.
const std::shared_ptr<const HingeLaw>& linear_hinge();

/// Stiffnesses of a hinge in its own frame. Those against stretching act on both points of the hinge
/// together. The others resist the turn about the hinge axis and tilting.
struct HingeStiffness {
  double axial = 2000;  ///< along the wall, perpendicular to the axis, N/mm
  double shear = 2000;  ///< perpendicular to wall and axis, N/mm
  double along = 2000;  ///< along the axis, N/mm
  double turn = 0.1;    ///< about the axis, N mm/rad
  /// Rock: about the direction perpendicular to wall and axis. Twist: about the wall's direction. N mm/rad.
  /// Empty: as given by the reach, axial reach^2 and shear reach^2.
  std::optional<double> rock = {}, twist = {};

  bool operator==(const HingeStiffness&) const = default;
};

/// Ratios of the stretching stiffnesses to 2 k_point, the stiffness of two springs k_point.
struct PointRatios {
  double axial = 1;  ///< dimensionless; fields as in HingeStiffness
  double shear = 1;
  double along = 1;

  /// Returns whether the hinge is just those two springs.
  bool are_one() const { return axial == 1 && shear == 1 && along == 1; }
  bool operator==(const PointRatios&) const = default;
};

/// Stiffnesses against tilting that override those given by the reach, as in HingeStiffness.
struct TiltStiffness {
  std::optional<double> rock = {}, twist = {};  ///< N mm/rad; in Stiffness in units of k_point edge^2

  /// Returns whether the reach alone gives the tilt stiffnesses.
  bool are_by_reach() const { return !rock && !twist; }
  bool operator==(const TiltStiffness&) const = default;
};

/// Elastic properties of the hinges and walls of a structure. Energy of a hinge (kinematics.md section 3):
///
///     k_point (|dp|^2 + reach^2 |dd|^2) + 1/2 k_turn turn^2        (the last term by `law`).
///
/// dp and dd are the mismatches of hinge point and unit hinge axis as its two bodies carry them. The first
/// term is the energy of two springs of stiffness k_point at the hinge point +- reach along the axis. The
/// second is a turning spring that is relaxed in the flat state. If `ratios` are not 1, |g|^2 of dp and of dd
/// is replaced by
///
///     shear |g|^2 + (axial - shear) (g . a)^2 + (along - shear) (g . c)^2.
///
/// a and c are unit vectors half way between the directions that the two bodies carry. For a, this direction
/// is that of the wall, made perpendicular to the axis at rest. For c, it is the axis. Both are undefined if
/// the bodies have turned against each other by half a turn. If `tilt` gives a stiffness, the term of dd is
///
///     1/2 twist |dd|^2 + 1/2 (rock - twist) (dd . a)^2
///
/// with axial reach^2 or shear reach^2 for a stiffness that `tilt` leaves empty. A hinge with clearance has
/// another energy (model/hinge/clearance_energy.hpp). The rigid-body simulation uses the same numbers.
struct Elasticity {
  double k_point = 1000;                                 ///< of each of the two points, N/mm
  double k_turn = 0.1;                                   ///< N mm/rad
  double reach_mm = 1.8;                                 ///< half distance of the two points, mm
  double k_contact = 1e4;                                ///< of two walls pressed into each other, N/mm
  std::shared_ptr<const HingeLaw> law = linear_hinge();  ///< of the turn, with k_turn; not null
  PointRatios ratios = {};                               ///< over 2 k_point
  TiltStiffness tilt = {};                               ///< N mm/rad
  double play_mm = 0;  ///< clearance per side, within which neither point resists
  /// One entry per hinge if the hinges differ, otherwise empty. With entries, only k_point (the unit of
  /// energies) and k_contact (of all walls) of this object are used. The entries' `each` are empty.
  std::vector<Elasticity> each = {};

  /// Returns the elasticity of a hinge.
  const Elasticity& of(std::size_t hinge) const { return each.empty() ? *this : each[hinge]; }

  /// Checks the ranges. All fields but play_mm are positive, from 1e-30 to 1e30, so that their ratios and
  /// products stay finite. The clearance play_mm is from 0 to the reach. A hinge with clearance is equally
  /// stiff along and across its wall, and its reach gives the tilt stiffnesses.
  /// @throws InvalidInput, naming the field, its value and its range
  void validate() const;
};

/// Elasticity relative to k_point and the cell edge: energies are in units of k_point edge^2, forces of
/// k_point edge.
struct Stiffness {
  double turn = 1e-6;   ///< k_turn, in units of k_point edge^2
  double reach = 0.18;  ///< cell edges; 0: none, for bodies that stay parallel
  double contact = 10;  ///< k_contact, in units of k_point
  std::shared_ptr<const HingeLaw> law = linear_hinge();
  PointRatios ratios = {};
  TiltStiffness tilt = {};           ///< in units of k_point edge^2
  double play = 0;                   ///< clearance per side, cell edges
  std::vector<Stiffness> each = {};  ///< one per hinge if they differ, relative to the k_point of the whole

  /// Returns whether the hinge is more than two springs k_point.
  bool framed() const { return !ratios.are_one() || !tilt.are_by_reach() || play > 0; }
  /// Returns whether the hinge resists tilting.
  bool tilts() const { return reach > 0 || !tilt.are_by_reach(); }
  /// Weights of the tilt energy w |dd|^2 + r (dd . a)^2 in k_point edge^2: w = twist / 2,
  /// r = (rock - twist) / 2.
  double twist_weight() const;
  double rock_beyond_twist() const;
  /// Removes reach and tilt, for bodies that stay parallel and so have no tilt.
  void drop_tilt();

  /// Returns the stiffness of a hinge. Its contact is that of the whole.
  const Stiffness& of(std::size_t hinge) const { return each.empty() ? *this : each[hinge]; }
  /// Returns the least turning stiffness of all hinges.
  double min_turn() const;
  /// @throws InvalidInput unless there is one for all hinges, or one each
  void check_count(std::size_t hinges) const;
};

/// Converts an elasticity to relative units, for a cell edge in mm.
Stiffness relative(const Elasticity& elasticity, double edge_mm);
/// Returns the elasticity of a hinge with these stiffnesses. k_point is half the largest of the first three,
/// N/mm; k_contact is ten times k_point.
Elasticity elasticity_of(const HingeStiffness& stiffness, double reach_mm);
/// Returns the stiffnesses that elasticity_of() turns into this elasticity. Ignores `each`.
HingeStiffness stiffness_of(const Elasticity& elasticity);
/// Returns k_point edge^2, N mm.
double energy_unit(const Elasticity& elasticity, double edge_mm);

}  // namespace kinetix::model
