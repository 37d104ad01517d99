#include "model/hinge/hinge_energy.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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

HingeEnergy hinge_energy(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                         double edge_mm) {
  const double point = point_mismatch(hinge, lower, upper, edge_mm).gap.squaredNorm();
  const double axis = k.reach > 0 ? axis_mismatch(hinge, lower, upper).gap.squaredNorm() : 0;
  const double angle = RelativeTurn(hinge, lower, upper).angle();
  return {point + k.reach * k.reach * axis, k.law->at(angle, k.turn).energy};
}

Element hinge_element(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                      double edge_mm) {
  Element e;
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  add_turning(point, 1, e);
  add_shifts(point, e);
  if (k.reach > 0) add_turning(axis_mismatch(hinge, lower, upper), k.reach * k.reach, e);
  const Element turn = RelativeTurn(hinge, lower, upper).element();
  const TurnResponse spring = k.law->at(turn.energy, k.turn);
  e.energy += spring.energy;
  e.gradient += spring.moment() * turn.gradient;
  e.hessian += spring.stiffness * (spring.stretch * turn.hessian + turn.gradient * turn.gradient.transpose());
  return e;
}

Vector12 hinge_gradient(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                        double edge_mm) {
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  const RelativeTurn turn(hinge, lower, upper);
  const Vector3d moment = k.law->at(turn.angle(), k.turn).moment() * turn.rate_in_space();
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
  const Vector3d lower_turn = along.segment<3>(0), upper_turn = along.segment<3>(6),
                 shift = along.segment<3>(3) - along.segment<3>(9),
                 against = upper.R.transpose() * (upper_turn - lower_turn);
  const auto drift = [&](const Mismatch& m) -> Vector3d {
    return lower_turn.cross(m.lower) - upper_turn.cross(m.upper);
  };
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  const Pull by_point = pull(point, lower, upper, lower_turn, upper_turn, drift(point) + shift);
  const RelativeTurn turn(hinge, lower, upper);
  const double angle_along = turn.rate().dot(against);
  const TurnResponse spring = k.law->at(turn.angle(), k.turn);
  const TurnRates turns = turn_rates(hinge, turn, against);

  HingeRates rates;
  rates.energy.design = spring.moment() * turns.turn;
  rates.along.design = spring.stiffness * (angle_along * turns.turn + spring.stretch * turns.along);
  rates.energy.design[0] += by_point.energy.dot(hinge.edge);
  rates.along.design[0] += by_point.along.dot(hinge.edge);
  rates.energy.design[3] += by_point.energy.dot(hinge.across);
  rates.along.design[3] += by_point.along.dot(hinge.across);
  rates.energy.turn = spring.energy_k;
  rates.along.turn = spring.moment_k * angle_along;
  if (!(k.reach > 0)) return rates;

  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  const Vector3d axis_drift = drift(axis);
  const Pull by_axis = pull(axis, lower, upper, lower_turn, upper_turn, axis_drift);
  const double weight = k.reach * k.reach;
  rates.energy.design[1] += weight * by_axis.energy.dot(hinge.axis_alpha);
  rates.energy.design[2] += weight * by_axis.energy.dot(hinge.axis_beta);
  rates.along.design[1] += weight * by_axis.along.dot(hinge.axis_alpha);
  rates.along.design[2] += weight * by_axis.along.dot(hinge.axis_beta);
  rates.energy.reach = 2 * k.reach * axis.gap.squaredNorm();
  rates.along.reach = 4 * k.reach * axis.gap.dot(axis_drift);
  return rates;
}

}  // namespace kinetix::model
