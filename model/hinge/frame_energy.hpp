#pragma once

#include "model/hinge/element.hpp"
#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::model {

/// Unit direction of the hinge's wall, from its lower to its upper body, made perpendicular to the axis.
Eigen::Vector3d wall_direction(const RestHinge& hinge);
/// How that changes where the unit axis does by `axis_rate`.
Eigen::Vector3d wall_direction_rate(const RestHinge& hinge, const Eigen::Vector3d& axis_rate);

/// First-order changes of a mismatch, of the direction w, and of both where what the bodies carry changes.
struct DirectedChange {
  Eigen::Vector3d gap = Eigen::Vector3d::Zero();  ///< cell edges or dimensionless, as the mismatch
  Eigen::Vector3d w = Eigen::Vector3d::Zero();    ///< dimensionless
};

/// The square of a mismatch's part along a direction half way between what the two bodies carry of it,
/// (g . w)^2 / |w|^2 with w = R_lower w0 + R_upper w0, and its derivatives. In cell edges squared or
/// dimensionless, as the mismatch. NaN where the bodies carry w0 in opposite directions.
class DirectedSquare {
 public:
  /// @param w0 unit vector at rest
  DirectedSquare(const Mismatch& mismatch, const Eigen::Vector3d& w0, const Pose& lower, const Pose& upper);

  double value() const { return m_ * s_; }
  /// By the twists, ordered as in Element. @param shifts whether the gap follows the shifts of the bodies
  Vector12 gradient(bool shifts) const;
  /// Value, gradient and Hessian, times `weight`.
  void add_to(Element& element, double weight, bool shifts) const;

  /// The change of the value that a change brings.
  double rate(const DirectedChange& change) const;
  /// The change of rate(along) that a change `by` of what the bodies carry brings.
  /// @param mixed second-order change along both
  double rate(const DirectedChange& along, const DirectedChange& by, const DirectedChange& mixed) const;
  const Eigen::Vector3d& w() const { return w_; }

 private:
  Vector12 s_rate(bool shifts) const;
  Vector12 n_rate() const;
  void add_s_hessian(Matrix12& h, double weight, bool shifts) const;
  void add_n_hessian(Matrix12& h, double weight) const;

  const Mismatch& g_;
  Eigen::Vector3d lower_, upper_, w_;  ///< w0 as carried, and their sum
  double s_, n_, m_;                   ///< g . w, |w|^2, their ratio
};

}  // namespace kinetix::model
