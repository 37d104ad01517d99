#pragma once

#include "model/contact/hinge_chains.hpp"
#include "model/linkage/state.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::model {

/// What a body does over an interval of theta, seen from another one: its twist in the middle, and bounds of how far it
/// leaves the motion of that twist. With w and v the twist of the body, a point r of it moves by r' = v + w x r; what is
/// bounded is the second derivative r'', so that r stays within change_of(r) half_width^2 / 2 of its straight path.
///
/// From body to body along hinges (n of them, axes a, rates of turning s):
///   w_n = w_(n-1) + s a,   w_n' = w_(n-1)' + s' a + s w_(n-1) x a,   r'' = w' x l + w x (w x l) + (anchor)''
/// with l from the hinge to the point. Each sum of absolute values is a bound: A of |w'|, W = |w(middle)| + h A of |w|,
/// and u of |w x a|, for which |(w x a)'| <= A + W |w x a| gives u <= (|w x a|(middle) + h A) / (1 - h W).
class SweptMotion {
 public:
  /// At rest, to begin with. @param half_width of the interval, rad
  explicit SweptMotion(double half_width) : h_(half_width) {}

  /// A first turn about an axis that stands still, at an even rate.
  /// @param point on the axis, mm   @param spin axis times rate, rad per rad
  void turn_about(const Eigen::Vector3d& point, const Eigen::Vector3d& spin);
  /// At a rate that stays the same: r' = v + omega x r. @param v of a point of the body at the origin, mm per rad
  void screw(const Eigen::Vector3d& omega, const Eigen::Vector3d& v);
  /// Beyond a hinge.
  /// @param point, axis of it in the middle of the interval   @param rate there, with sign   @param bounds of it
  void pass(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, double rate, const RateBounds& bounds);

  const Eigen::Vector3d& omega() const { return omega_; }
  /// Of a point of the body at r in the middle of the interval, mm per rad.
  Eigen::Vector3d speed(const Eigen::Vector3d& r) const { return v_ + omega_.cross(r); }
  /// Bound of the second derivative of that point, and of all within `reach` of it, mm per rad^2.
  double change(const Eigen::Vector3d& r, double reach) const;
  /// The same along a unit direction n: a body that turns about one axis a alone has n . r'' = (n x a) . (s' l + s^2 a x l),
  /// which vanishes along the axis.
  double change_along(const Eigen::Vector3d& n, const Eigen::Vector3d& r, double reach) const;
  /// How far these get from where they are in the middle, mm.
  double way(const Eigen::Vector3d& r, double reach) const;

 private:
  double h_;                                          ///< rad
  Eigen::Vector3d omega_ = Eigen::Vector3d::Zero();   ///< rad per rad
  Eigen::Vector3d v_ = Eigen::Vector3d::Zero();       ///< of a point of the body at the origin, mm per rad
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();  ///< the last hinge, mm
  double most_omega_ = 0;                             ///< W, rad per rad
  double omega_change_ = 0;                           ///< A, rad per rad^2
  double anchor_change_ = 0;                          ///< of the last hinge, mm per rad^2
  int turns_ = 0;                                     ///< hinges that were passed, or the one of a screw
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero();    ///< unit vector, of the last one
};

}  // namespace kinetix::model
