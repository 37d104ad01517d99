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
  double angle() const {
    const double whole = 2 * std::atan2(s, w);
    return std::abs(whole) > pi ? whole - std::copysign(2 * pi, whole) : whole;
  }
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

/// |gap|^2 and its derivative along twists, both by the rest vector that the two bodies carry.
struct Pull {
  Vector3d energy, along;
};

/// @param drift first-order change of the gap along the twists
Pull pull(const Mismatch& m, const Pose& lower, const Pose& upper, const Vector3d& lower_turn,
          const Vector3d& upper_turn, const Vector3d& drift) {
  return {2 * ((lower.R - upper.R).transpose() * m.gap),
          2 * (lower.R.transpose() * (drift + m.gap.cross(lower_turn)) -
               upper.R.transpose() * (drift + m.gap.cross(upper_turn)))};
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
  const double axis = k.reach > 0 ? axis_mismatch(hinge, lower, upper).gap.squaredNorm() : 0;
  const double angle = Turn(hinge, lower, upper).angle();
  return {point + k.reach * k.reach * axis, 0.5 * k.turn * angle * angle};
}

Element hinge_element(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                      double edge_mm) {
  Element e;
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  add_turning(point, 1, e);
  add_shifts(point, e);
  if (k.reach > 0) add_turning(axis_mismatch(hinge, lower, upper), k.reach * k.reach, e);
  const Element turn = turn_element(hinge, lower, upper);
  e.energy += 0.5 * k.turn * turn.energy * turn.energy;
  e.gradient += k.turn * turn.energy * turn.gradient;
  e.hessian += k.turn * (turn.energy * turn.hessian + turn.gradient * turn.gradient.transpose());
  return e;
}

Vector12 hinge_gradient(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                        double edge_mm) {
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  const Turn turn(hinge, lower, upper);
  const Vector3d moment = k.turn * turn.angle() * (turn.upper * turn.rate());
  Vector12 g;
  g << 2 * point.lower.cross(point.gap) - moment, 2 * point.gap, moment - 2 * point.upper.cross(point.gap),
      -2 * point.gap;
  if (!(k.reach > 0)) return g;
  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  const double weight = 2 * k.reach * k.reach;
  g.segment<3>(0) += weight * axis.lower.cross(axis.gap);
  g.segment<3>(6) -= weight * axis.upper.cross(axis.gap);
  return g;
}

HingeRates hinge_rates(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                       double edge_mm, const Vector12& along) {
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm), axis = axis_mismatch(hinge, lower, upper);
  const Vector3d lower_turn = along.segment<3>(0), upper_turn = along.segment<3>(6),
                 shift = along.segment<3>(3) - along.segment<3>(9),
                 against = upper.R.transpose() * (upper_turn - lower_turn);
  const auto drift = [&](const Mismatch& m) -> Vector3d {
    return lower_turn.cross(m.lower) - upper_turn.cross(m.upper);
  };
  const Vector3d axis_drift = drift(axis);
  const Pull by_point = pull(point, lower, upper, lower_turn, upper_turn, drift(point) + shift),
             by_axis = pull(axis, lower, upper, lower_turn, upper_turn, axis_drift);
  const Turn turn(hinge, lower, upper);
  const double angle = turn.angle(), angle_along = turn.rate().dot(against);
  const TurnRates turns = turn_rates(hinge, turn, against);

  const double weight = k.reach * k.reach;
  const auto design = [&](const Vector3d& of_point, const Vector3d& of_axis) -> Vector3d {
    return {of_point.dot(hinge.edge), weight * of_axis.dot(hinge.axis_alpha), weight * of_axis.dot(hinge.axis_beta)};
  };

  HingeRates rates;
  rates.energy.design = k.turn * angle * turns.turn + design(by_point.energy, by_axis.energy);
  rates.along.design =
      k.turn * (angle_along * turns.turn + angle * turns.along) + design(by_point.along, by_axis.along);
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
  return turn_rates(hinge, Turn(hinge, lower, upper),
                    upper.R.transpose() * (along.segment<3>(6) - along.segment<3>(0)));
}

}  // namespace kinetix
