#include "model/elastic/hinge_energy.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kinetix {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Two vectors carried by the two bodies whose difference `gap` is penalised; arms turn with the bodies.
struct Mismatch {
  Vector3d gap, lower, upper;
};

Mismatch point_mismatch(const RestHinge& h, const Pose& lower, const Pose& upper, double edge_mm) {
  Mismatch m;
  m.lower = lower.R * h.lower_arm;
  m.upper = upper.R * h.upper_arm;
  m.gap = (lower.p - upper.p) / edge_mm + m.lower - m.upper;
  return m;
}

Mismatch axis_mismatch(const RestHinge& h, const Pose& lower, const Pose& upper) {
  Mismatch m;
  m.lower = lower.R * h.axis;
  m.upper = upper.R * h.axis;
  m.gap = m.lower - m.upper;
  return m;
}

void add_turning(const Mismatch& m, double weight, Element& e) {
  const Matrix3d a = cross_matrix(m.lower), b = cross_matrix(m.upper);
  e.energy += weight * m.gap.squaredNorm();
  e.gradient.segment<3>(0) += 2 * weight * m.lower.cross(m.gap);
  e.gradient.segment<3>(6) -= 2 * weight * m.upper.cross(m.gap);
  e.hessian.block<3, 3>(0, 0) += 2 * weight * (turning_hessian(m.gap, m.lower) - a * a);
  e.hessian.block<3, 3>(6, 6) -= 2 * weight * (turning_hessian(m.gap, m.upper) + b * b);
  const Matrix3d coupling = 2 * weight * (a * b);
  e.hessian.block<3, 3>(0, 6) += coupling;
  e.hessian.block<3, 3>(6, 0) += coupling.transpose();
}

/// The terms of a point mismatch with the shifts of the bodies.
void add_shifts(const Mismatch& m, Element& e) {
  const Matrix3d a = 2 * cross_matrix(m.lower), b = 2 * cross_matrix(m.upper);
  e.gradient.segment<3>(3) += 2 * m.gap;
  e.gradient.segment<3>(9) -= 2 * m.gap;
  e.hessian.block<3, 3>(0, 3) += a;
  e.hessian.block<3, 3>(3, 0) -= a;
  e.hessian.block<3, 3>(0, 9) -= a;
  e.hessian.block<3, 3>(9, 0) += a;
  e.hessian.block<3, 3>(6, 3) -= b;
  e.hessian.block<3, 3>(3, 6) += b;
  e.hessian.block<3, 3>(6, 9) += b;
  e.hessian.block<3, 3>(9, 6) -= b;
  for (int k = 0; k < 3; ++k) {
    e.hessian(3 + k, 3 + k) += 2;
    e.hessian(9 + k, 9 + k) += 2;
    e.hessian(3 + k, 9 + k) -= 2;
    e.hessian(9 + k, 3 + k) -= 2;
  }
}

/// The relative turn of two bodies by its unit quaternion, split along the hinge axis.
struct Turn {
  double w = 1, s = 0;  ///< scalar part; vector part along the axis
  Vector3d v, w_rate, s_rate;
  Matrix3d upper;

  Turn(const RestHinge& h, const Pose& low, const Pose& up)
      : Turn(Quaterniond(low.R.transpose() * up.R), h.axis, up.R) {}

  Turn(const Quaterniond& q, const Vector3d& axis, const Matrix3d& upper_R)
      : w(q.w()), s(q.vec().dot(axis)), v(q.vec()), upper(upper_R) {
    w_rate = -0.5 * v;
    s_rate = 0.5 * (w * axis + axis.cross(v));
  }

  double squared() const { return w * w + s * s; }
  double angle() const { return std::remainder(2 * std::atan2(s, w), 2 * pi); }
  /// By a turn of the upper body in the upper body's frame.
  Vector3d rate() const { return 2 * (w * s_rate - s * w_rate) / squared(); }
  Matrix3d second() const {
    const double n = squared();
    const double ss = -4 * w * s / (n * n), sw = 2 * (s * s - w * w) / (n * n);
    const Matrix3d mixed = s_rate * w_rate.transpose();
    return ss * (s_rate * s_rate.transpose() - w_rate * w_rate.transpose()) +
           sw * (mixed + mixed.transpose());
  }
  /// Derivative of rate() where the axis changes by `axis_rate`.
  Vector3d rate_change(const Vector3d& axis_rate) const {
    const double ds = v.dot(axis_rate), n = squared();
    const Vector3d ds_rate = 0.5 * (w * axis_rate + axis_rate.cross(v));
    return 2 * (w * ds_rate - ds * w_rate) / n - 2 * s * ds / n * rate();
  }
  double angle_change(const Vector3d& axis_rate) const { return 2 * w * v.dot(axis_rate) / squared(); }
};

/// @param against turn of the upper body against the lower one, in the upper body's frame
TurnRates turn_rates(const RestHinge& hinge, const Turn& turn, const Vector3d& against) {
  TurnRates rates;
  rates.turn[1] = turn.angle_change(hinge.axis_alpha);
  rates.turn[2] = turn.angle_change(hinge.axis_beta);
  rates.along[1] = turn.rate_change(hinge.axis_alpha).dot(against);
  rates.along[2] = turn.rate_change(hinge.axis_beta).dot(against);
  return rates;
}

Vector3d turn_against(const Vector12& along, const Pose& upper) {
  return upper.R.transpose() * (along.segment<3>(6) - along.segment<3>(0));
}

Element turn_element(const Turn& turn) {
  Element e;
  const Vector3d g = turn.upper * turn.rate();
  const Matrix3d m = turn.upper * turn.second() * turn.upper.transpose();
  const Matrix3d half = 0.5 * cross_matrix(g);
  e.energy = turn.angle();
  e.gradient.segment<3>(0) = -g;
  e.gradient.segment<3>(6) = g;
  e.hessian.block<3, 3>(0, 0) = m;
  e.hessian.block<3, 3>(6, 6) = m;
  e.hessian.block<3, 3>(0, 6) = half - m;
  e.hessian.block<3, 3>(6, 0) = -half - m;
  return e;
}

Mismatch carried(const Vector3d& rest, const Pose& lower, const Pose& upper) {
  const Vector3d a = lower.R * rest, b = upper.R * rest;
  return {a - b, a, b};
}

/// Change of the gap as the two bodies turn.
Vector3d drift(const Mismatch& m, const Vector12& along) {
  return along.segment<3>(0).cross(m.lower) - along.segment<3>(6).cross(m.upper);
}

}  // namespace

RestHinge rest_hinge(const Hinge& hinge) {
  const auto& [t, alpha, beta] = hinge.parameters;
  const Axis axis = hinge.wall.axis;
  RestHinge out;
  out.lower = hinge.lower;
  out.upper = hinge.upper;
  out.edge = edge_direction(axis);
  out.lower_arm = t * out.edge;
  out.upper_arm = (t - 1) * out.edge;
  out.axis = hinge_axis(axis, hinge.parameters);
  out.axis_alpha = -std::sin(alpha) * out.edge + std::cos(alpha) * wall_up(axis, beta);
  out.axis_beta = std::sin(alpha) * wall_up(axis, beta + pi / 2);
  return out;
}

HingeEnergy hinge_energy(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                         double edge_mm) {
  const double point = point_mismatch(hinge, lower, upper, edge_mm).gap.squaredNorm();
  const double axis = axis_mismatch(hinge, lower, upper).gap.squaredNorm();
  const double angle = Turn(hinge, lower, upper).angle();
  return {point + k.reach * k.reach * axis, 0.5 * k.turn * angle * angle};
}

Element hinge_element(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                      double edge_mm) {
  Element e;
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  add_turning(point, 1, e);
  add_shifts(point, e);
  add_turning(axis_mismatch(hinge, lower, upper), k.reach * k.reach, e);
  const Element turn = turn_element(hinge, lower, upper);
  e.energy += 0.5 * k.turn * turn.energy * turn.energy;
  e.gradient += k.turn * turn.energy * turn.gradient;
  e.hessian += k.turn * (turn.energy * turn.hessian + turn.gradient * turn.gradient.transpose());
  return e;
}

HingeRates hinge_rates(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                       double edge_mm, const Vector12& along) {
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm), axis = axis_mismatch(hinge, lower, upper);
  const Vector3d point_drift = drift(point, along) + along.segment<3>(3) - along.segment<3>(9),
                 axis_drift = drift(axis, along);
  const Turn turn(hinge, lower, upper);
  const Vector3d against = turn_against(along, upper);
  const double angle = turn.angle(), angle_along = turn.rate().dot(against);
  const TurnRates turns = turn_rates(hinge, turn, against);

  HingeRates rates;
  rates.energy.design = k.turn * angle * turns.turn;
  rates.along.design = k.turn * (angle_along * turns.turn + angle * turns.along);
  const auto add = [&](int column, const Mismatch& m, const Vector3d& m_drift, const Vector3d& rest_rate,
                       double weight) {
    const Mismatch rate = carried(rest_rate, lower, upper);
    rates.energy.design[column] += 2 * weight * m.gap.dot(rate.gap);
    rates.along.design[column] += 2 * weight * (rate.gap.dot(m_drift) + m.gap.dot(drift(rate, along)));
  };
  add(0, point, point_drift, hinge.edge, 1);
  add(1, axis, axis_drift, hinge.axis_alpha, k.reach * k.reach);
  add(2, axis, axis_drift, hinge.axis_beta, k.reach * k.reach);
  rates.energy.turn = 0.5 * angle * angle;
  rates.along.turn = angle * angle_along;
  rates.energy.reach = 2 * k.reach * axis.gap.squaredNorm();
  rates.along.reach = 4 * k.reach * axis.gap.dot(axis_drift);
  return rates;
}

Element turn_element(const RestHinge& hinge, const Pose& lower, const Pose& upper) {
  return turn_element(Turn(hinge, lower, upper));
}

TurnRates turn_rates(const RestHinge& hinge, const Pose& lower, const Pose& upper, const Vector12& along) {
  return turn_rates(hinge, Turn(hinge, lower, upper), turn_against(along, upper));
}

}  // namespace kinetix
