#pragma once

#include "model/contact/hinge_chains.hpp"
#include "model/linkage/state.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::model {

/// Motion of a body over an interval of theta, relative to another body: its twist in the middle, with bounds of its
/// deviation. With w and v the twist of the body, its point r moves by r' = v + w x r. The bounded quantity is the
/// second derivative r'', so that r stays within change(r) half_width^2 / 2 of its straight path.
///
/// Along hinges from body to body (n of them, axes a, rates of turning s):
///   w_n = w_(n-1) + s a,   w_n' = w_(n-1)' + s' a + s w_(n-1) x a,   r'' = w' x l + w x (w x l) + (anchor)''
/// with l from the hinge to the point. Each sum of absolute values is a bound: A of |w'|, W = |w(middle)| + h A of |w|,
/// and u of |w x a|, for which |(w x a)'| <= A + W |w x a| gives u <= (|w x a|(middle) + h A) / (1 - h W).
class SweptMotion {
 public:
  /// Starts at rest. @param half_width of the interval, rad
  explicit SweptMotion(double half_width) : h_(half_width) {}

  /// Adds a first turn about a fixed axis, at a constant rate.
  /// @param point on the axis, mm   @param spin axis times rate, rad per rad
  void turn_about(const Eigen::Vector3d& point, const Eigen::Vector3d& spin);
  /// Sets a constant twist: r' = v + omega x r. @param v velocity of the body's point at the origin, mm per rad
  void screw(const Eigen::Vector3d& omega, const Eigen::Vector3d& v);
  /// Adds a hinge between the present body and the next one.
  /// @param point, axis position (mm) and unit axis of the hinge in the middle of the interval   @param rate signed
  /// rate there   @param bounds of the rate
  void pass(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, double rate, const RateBounds& bounds);

  const Eigen::Vector3d& omega() const { return omega_; }
  /// Returns the velocity of a point of the body at r in the middle of the interval, mm per rad.
  Eigen::Vector3d speed(const Eigen::Vector3d& r) const { return v_ + omega_.cross(r); }
  /// Returns a bound of the second derivative of that point, and of all points within `reach` of it, mm per rad^2.
  double change(const Eigen::Vector3d& r, double reach) const;
  /// Returns a bound of the second derivative along a unit direction n. A body that turns only about one axis a has n
  /// . r'' = (n x a) . (s' l + s^2 a x l), which vanishes along the axis.
  double change_along(const Eigen::Vector3d& n, const Eigen::Vector3d& r, double reach) const;
  /// Returns a bound of the displacement of these points from the middle of the interval, mm.
  double way(const Eigen::Vector3d& r, double reach) const;

 private:
  double h_;                                         ///< rad
  Eigen::Vector3d omega_ = Eigen::Vector3d::Zero();  ///< rad per rad
  Eigen::Vector3d v_ = Eigen::Vector3d::Zero();  ///< velocity of the body's point at the origin, mm per rad
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();  ///< position of the last hinge, mm
  double most_omega_ = 0;                             ///< W, rad per rad
  double omega_change_ = 0;                           ///< A, rad per rad^2
  double anchor_change_ = 0;                          ///< bound for the last hinge, mm per rad^2
  int turns_ = 0;                                     ///< number of hinges passed, or 1 for a screw
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero();    ///< unit vector, axis of the last hinge
};

}  // namespace kinetix::model
