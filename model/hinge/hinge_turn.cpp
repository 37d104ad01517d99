#include "model/hinge/hinge_turn.hpp"

#include <cmath>

namespace kinetix::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

RelativeTurn::RelativeTurn(const RestHinge& hinge, const Pose& lower, const Pose& upper) : upper_(upper.R) {
  const Eigen::Quaterniond q(lower.R.transpose() * upper.R);
  w_ = q.w();
  v_ = q.vec();
  s_ = v_.dot(hinge.axis);
  w_rate_ = -0.5 * v_;
  s_rate_ = 0.5 * (w_ * hinge.axis + hinge.axis.cross(v_));
}

double RelativeTurn::angle() const {
  const double whole = 2 * std::atan2(s_, w_);
  return std::abs(whole) > pi ? whole - std::copysign(2 * pi, whole) : whole;
}

Vector3d RelativeTurn::rate() const { return 2 * (w_ * s_rate_ - s_ * w_rate_) / squared(); }

Matrix3d RelativeTurn::second() const {
  const double n = squared();
  const double ss = -4 * w_ * s_ / (n * n), sw = 2 * (s_ * s_ - w_ * w_) / (n * n);
  const Matrix3d mixed = s_rate_ * w_rate_.transpose();
  return ss * (s_rate_ * s_rate_.transpose() - w_rate_ * w_rate_.transpose()) +
         sw * (mixed + mixed.transpose());
}

double RelativeTurn::angle_change(const Vector3d& axis_rate) const {
  return 2 * w_ * v_.dot(axis_rate) / squared();
}

Vector3d RelativeTurn::rate_change(const Vector3d& axis_rate) const {
  const double ds = v_.dot(axis_rate), n = squared();
  const Vector3d ds_rate = 0.5 * (w_ * axis_rate + axis_rate.cross(v_));
  return 2 * (w_ * ds_rate - ds * w_rate_) / n - 2 * s_ * ds / n * rate();
}

Element RelativeTurn::element() const {
  Element e;
  const Vector3d g = rate_in_space();
  const Matrix3d m = upper_ * second() * upper_.transpose();
  const Matrix3d half = 0.5 * cross_matrix(g);
  e.energy = angle();
  e.gradient.segment<3>(0) = -g;
  e.gradient.segment<3>(6) = g;
  e.hessian.block<3, 3>(0, 0) = m;
  e.hessian.block<3, 3>(6, 6) = m;
  e.hessian.block<3, 3>(0, 6) = half - m;
  e.hessian.block<3, 3>(6, 0) = -half - m;
  return e;
}

TurnGradients turn_gradients(const RestHinge& hinge, const RelativeTurn& turn, const Vector3d& against) {
  TurnGradients derivatives;
  derivatives.turn[1] = turn.angle_change(hinge.axis_alpha);
  derivatives.turn[2] = turn.angle_change(hinge.axis_beta);
  derivatives.along[1] = turn.rate_change(hinge.axis_alpha).dot(against);
  derivatives.along[2] = turn.rate_change(hinge.axis_beta).dot(against);
  return derivatives;
}

TurnGradients turn_gradients(const RestHinge& hinge, const Pose& lower, const Pose& upper,
                             const Vector12& along) {
  return turn_gradients(hinge, RelativeTurn(hinge, lower, upper),
                        upper.R.transpose() * (along.segment<3>(6) - along.segment<3>(0)));
}

}  // namespace kinetix::model
