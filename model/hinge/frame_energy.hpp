#pragma once

#include "model/hinge/element.hpp"
#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::model {

/// Returns the unit direction of the hinge's wall, from lower to upper body, made perpendicular to the axis.
Eigen::Vector3d wall_direction(const RestHinge& hinge);
/// Returns the change of wall_direction() if the unit axis changes by `axis_rate`.
Eigen::Vector3d wall_direction_rate(const RestHinge& hinge, const Eigen::Vector3d& axis_rate);

/// First-order changes of a mismatch and of the direction w of DirectedSquare.
struct DirectedChange {
  Eigen::Vector3d gap = Eigen::Vector3d::Zero();  ///< in cell edges or dimensionless, as the mismatch
  Eigen::Vector3d w = Eigen::Vector3d::Zero();    ///< dimensionless
};

/// Square of a mismatch's part along a direction half way between those that the two bodies carry: (g . w)^2
/// / |w|^2 with w = R_lower w0 + R_upper w0, and its derivatives. In cell edges squared or dimensionless, as
/// the mismatch. NaN if the bodies carry w0 in opposite directions.
class DirectedSquare {
 public:
  /// @param w0 unit vector at rest
  DirectedSquare(const Mismatch& mismatch, const Eigen::Vector3d& w0, const Pose& lower, const Pose& upper);

  double value() const { return m_ * s_; }
  /// Returns the gradient by the twists, ordered as in Element. @param shifts whether the gap follows the
  /// bodies' shifts
  Vector12 gradient(bool shifts) const;
  /// Adds value, gradient and Hessian, times `weight`.
  void add_to(Element& element, double weight, bool shifts) const;

  /// Returns the first-order change of the value.
  double rate(const DirectedChange& change) const;
  /// Returns the change of rate(along) if the vectors that the bodies carry change by `by`.
  /// @param mixed second-order change along both
  double rate(const DirectedChange& along, const DirectedChange& by, const DirectedChange& mixed) const;
  const Eigen::Vector3d& w() const { return w_; }

 private:
  Vector12 s_rate(bool shifts) const;
  Vector12 n_rate() const;
  void add_s_hessian(Matrix12& h, double weight, bool shifts) const;
  void add_n_hessian(Matrix12& h, double weight) const;

  const Mismatch& g_;
  Eigen::Vector3d lower_, upper_, w_;  ///< w0 as each body carries it, and the sum of both
  double s_, n_, m_;                   ///< g . w, |w|^2, and their ratio
};

}  // namespace kinetix::model
