#pragma once

#include <Eigen/Geometry>

#include "model/base/geometry.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Energy between two bodies with its derivatives by their twists: a's turn omega (rad), a's shift (cell
/// edges), then b's, as in model/closure/closure.hpp. The Hessian is that of the energy after each body has
/// turned by exp(omega). The producer of the element defines its unit: k_point edge^2 for a hinge.
struct Element {
  double energy = 0;
  Vector12 gradient = Vector12::Zero();
  Matrix12 hessian = Matrix12::Zero();
};

/// Returns the Hessian by omega of f . (exp(omega) arm) at omega = 0.
inline Eigen::Matrix3d turning_hessian(const Eigen::Vector3d& f, const Eigen::Vector3d& arm) {
  Eigen::Matrix3d m = 0.5 * (f * arm.transpose() + arm * f.transpose());
  m.diagonal().array() -= f.dot(arm);
  return m;
}

/// Adds |gap|^2 of a mismatch times `weight`, with its derivatives by the turns of the two bodies.
void add_turning(const Mismatch& mismatch, double weight, Element& element);
/// Adds the derivatives of a point's |gap|^2 that involve the shifts of the bodies.
void add_shifts(const Mismatch& mismatch, double weight, Element& element);

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

/// Changes of a hinge's mismatches and frame: along twists of its two bodies, by changes of the vectors that
/// they carry, and by both.
class HingeChanges {
 public:
  HingeChanges(const Pose& lower, const Pose& upper, const Vector12& along)
      : lower_(lower.R),
        upper_(upper.R),
        lower_turn_(along.segment<3>(0)),
        upper_turn_(along.segment<3>(6)),
        shift_(along.segment<3>(3) - along.segment<3>(9)) {}

  DirectedChange along(const Mismatch& m, const Eigen::Vector3d& w0, bool shifts) const {
    Eigen::Vector3d gap = lower_turn_.cross(m.lower) - upper_turn_.cross(m.upper);
    if (shifts) gap += shift_;
    return {gap, lower_turn_.cross(lower_ * w0) + upper_turn_.cross(upper_ * w0)};
  }
  /// @param rest change of the vector whose mismatch is taken   @param w change of w0
  DirectedChange by(const Eigen::Vector3d& rest, const Eigen::Vector3d& w) const {
    return {lower_ * rest - upper_ * rest, lower_ * w + upper_ * w};
  }
  DirectedChange both(const Eigen::Vector3d& rest, const Eigen::Vector3d& w) const {
    return {lower_turn_.cross(lower_ * rest) - upper_turn_.cross(upper_ * rest),
            lower_turn_.cross(lower_ * w) + upper_turn_.cross(upper_ * w)};
  }

 private:
  const Eigen::Matrix3d &lower_, &upper_;
  const Eigen::Vector3d lower_turn_, upper_turn_, shift_;
};

}  // namespace kinetix::model
