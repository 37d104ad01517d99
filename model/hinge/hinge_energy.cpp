#include "model/hinge/hinge_energy.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "model/hinge/frame_energy.hpp"
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
void add_shifts(const Mismatch& m, double weight, Element& e) {
  const double twice = 2 * weight;
  const Matrix3d a = twice * cross_matrix(m.lower), b = twice * cross_matrix(m.upper);
  e.gradient.segment<3>(3) += twice * m.gap;
  e.gradient.segment<3>(9) -= twice * m.gap;
  e.hessian.block<3, 3>(0, 3) += a;
  e.hessian.block<3, 3>(3, 0) -= a;
  e.hessian.block<3, 3>(0, 9) -= a;
  e.hessian.block<3, 3>(9, 0) += a;
  e.hessian.block<3, 3>(6, 3) -= b;
  e.hessian.block<3, 3>(3, 6) += b;
  e.hessian.block<3, 3>(6, 9) += b;
  e.hessian.block<3, 3>(9, 6) -= b;
  for (int k = 0; k < 3; ++k) {
    e.hessian(3 + k, 3 + k) += twice;
    e.hessian(9 + k, 9 + k) += twice;
    e.hessian(3 + k, 9 + k) -= twice;
    e.hessian(9 + k, 3 + k) -= twice;
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

/// What a hinge has along the directions of its own frame besides springs of its shear stiffness in all of
/// them. The axis has no mismatch along itself: both bodies carry a unit vector.
class FrameTerms {
 public:
  FrameTerms(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
             const Mismatch& point, const Mismatch& axis)
      : axial(k.ratios.axial - k.ratios.shear),
        along(k.ratios.along - k.ratios.shear),
        tilt(k.reach * k.reach),
        wall(wall_direction(hinge)),
        point_axial(point, wall, lower, upper),
        point_along(point, hinge.axis, lower, upper),
        axis_axial(axis, wall, lower, upper) {}

  double energy() const {
    return axial * (point_axial.value() + tilt * axis_axial.value()) + along * point_along.value();
  }
  Vector12 gradient() const {
    Vector12 g = axial * point_axial.gradient(true) + along * point_along.gradient(true);
    if (tilt > 0) g += axial * tilt * axis_axial.gradient(false);
    return g;
  }
  void add_to(Element& e) const {
    point_axial.add_to(e, axial, true);
    point_along.add_to(e, along, true);
    if (tilt > 0) axis_axial.add_to(e, axial * tilt, false);
  }

  const double axial, along;  ///< beyond shear, of PointRatios
  const double tilt;          ///< reach squared, cell edges squared

  const Vector3d wall;  ///< at rest
  const DirectedSquare point_axial, point_along, axis_axial;
};

}  // namespace

HingeEnergy hinge_energy(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                         double edge_mm) {
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  const double angle = RelativeTurn(hinge, lower, upper).angle();
  const double turn = k.law->at(angle, k.turn).energy;
  if (k.ratios.are_one() && !(k.reach > 0)) return {point.gap.squaredNorm(), turn};
  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  const double stretch = point.gap.squaredNorm() + k.reach * k.reach * axis.gap.squaredNorm();
  if (k.ratios.are_one()) return {stretch, turn};
  return {k.ratios.shear * stretch + FrameTerms(hinge, k, lower, upper, point, axis).energy(), turn};
}

Element hinge_element(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                      double edge_mm) {
  Element e;
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  add_turning(point, k.ratios.shear, e);
  add_shifts(point, k.ratios.shear, e);
  const bool framed = !k.ratios.are_one();
  if (k.reach > 0 || framed) {
    const Mismatch axis = axis_mismatch(hinge, lower, upper);
    if (k.reach > 0) add_turning(axis, k.ratios.shear * (k.reach * k.reach), e);
    if (framed) FrameTerms(hinge, k, lower, upper, point, axis).add_to(e);
  }
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
  const double twice = 2 * k.ratios.shear;
  const bool framed = !k.ratios.are_one();
  Vector12 g;
  g << twice * point.lower.cross(point.gap) - moment, twice * point.gap,
      moment - twice * point.upper.cross(point.gap), -twice * point.gap;
  if (!(k.reach > 0) && !framed) return g;
  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  const double weight = twice * k.reach * k.reach;
  g.segment<3>(0) += weight * axis.lower.cross(axis.gap);
  g.segment<3>(6) -= weight * axis.upper.cross(axis.gap);
  if (framed) g += FrameTerms(hinge, k, lower, upper, point, axis).gradient();
  return g;
}

namespace {

/// How the mismatches and the frame of a hinge change: along twists of its two bodies, by what they carry, and
/// by both.
class HingeChanges {
 public:
  HingeChanges(const Pose& lower, const Pose& upper, const Vector12& along)
      : lower_(lower.R),
        upper_(upper.R),
        lower_turn_(along.segment<3>(0)),
        upper_turn_(along.segment<3>(6)),
        shift_(along.segment<3>(3) - along.segment<3>(9)) {}

  DirectedChange along(const Mismatch& m, const Vector3d& w0, bool shifts) const {
    Vector3d gap = lower_turn_.cross(m.lower) - upper_turn_.cross(m.upper);
    if (shifts) gap += shift_;
    return {gap, lower_turn_.cross(lower_ * w0) + upper_turn_.cross(upper_ * w0)};
  }
  /// @param rest change of the vector between which the mismatch is, `w` that of w0
  DirectedChange by(const Vector3d& rest, const Vector3d& w) const {
    return {lower_ * rest - upper_ * rest, lower_ * w + upper_ * w};
  }
  DirectedChange both(const Vector3d& rest, const Vector3d& w) const {
    return {lower_turn_.cross(lower_ * rest) - upper_turn_.cross(upper_ * rest),
            lower_turn_.cross(lower_ * w) + upper_turn_.cross(upper_ * w)};
  }

 private:
  const Eigen::Matrix3d &lower_, &upper_;
  const Vector3d lower_turn_, upper_turn_, shift_;
};

/// A DirectedSquare, its derivative along twists, and how both change by the design.
struct SquareRates {
  double value = 0, along = 0;
  DesignRates value_design = DesignRates::Zero(), along_design = DesignRates::Zero();
};

/// @param rest, w changes by t, alpha, beta and offset of what the bodies carry: see HingeChanges::by
SquareRates square_rates(const DirectedSquare& square, const DirectedChange& along,
                         const HingeChanges& changes, const std::array<Vector3d, 4>& rest,
                         const std::array<Vector3d, 4>& w) {
  SquareRates out{square.value(), square.rate(along)};
  for (int k = 0; k < 4; ++k) {
    const DirectedChange by = changes.by(rest[k], w[k]);
    out.value_design[k] = square.rate(by);
    out.along_design[k] = square.rate(along, by, changes.both(rest[k], w[k]));
  }
  return out;
}

void add(double weight, const SquareRates& square, HingeRates& rates) {
  rates.energy.design += weight * square.value_design;
  rates.along.design += weight * square.along_design;
}

/// What FrameTerms has of the rates. On entry, ratios.shear is that of all directions alike.
void add_frame_rates(const RestHinge& h, const Stiffness& k, const Pose& lower, const Pose& upper,
                     const Mismatch& point, const Mismatch& axis, const Vector12& along, HingeRates& rates) {
  const FrameTerms frame(h, k, lower, upper, point, axis);
  const HingeChanges changes(lower, upper, along);
  const Vector3d zero = Vector3d::Zero(), wall = wall_direction(h);
  const std::array<Vector3d, 4> arms{h.edge, zero, zero, h.across},
      axes{zero, h.axis_alpha, h.axis_beta, zero},
      walls{zero, wall_direction_rate(h, h.axis_alpha), wall_direction_rate(h, h.axis_beta), zero};
  const SquareRates point_axial = square_rates(frame.point_axial, changes.along(point, wall, true), changes,
                                               arms, walls),
                    point_along = square_rates(frame.point_along, changes.along(point, h.axis, true), changes,
                                               arms, axes),
                    tilt = square_rates(frame.axis_axial, changes.along(axis, wall, false), changes, axes,
                                        walls);
  if (!k.ratios.are_one()) {
    add(frame.axial, point_axial, rates);
    add(frame.along, point_along, rates);
    add(frame.axial * frame.tilt, tilt, rates);
  }
  if (!k.ratios.are_one() && k.reach > 0) {
    rates.energy.reach += 2 * k.reach * frame.axial * tilt.value;
    rates.along.reach += 2 * k.reach * frame.axial * tilt.along;
  }
  const double axial = point_axial.value + frame.tilt * tilt.value,
               axial_along = point_axial.along + frame.tilt * tilt.along;
  rates.energy.ratios = {axial, rates.energy.ratios.shear - axial - point_along.value, point_along.value};
  rates.along.ratios = {axial_along, rates.along.ratios.shear - axial_along - point_along.along,
                        point_along.along};
}

}  // namespace

HingeRates hinge_rates(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                       double edge_mm, const Vector12& along) {
  const Vector3d lower_turn = along.segment<3>(0), upper_turn = along.segment<3>(6),
                 shift = along.segment<3>(3) - along.segment<3>(9),
                 against = upper.R.transpose() * (upper_turn - lower_turn);
  const auto drift = [&](const Mismatch& m) -> Vector3d {
    return lower_turn.cross(m.lower) - upper_turn.cross(m.upper);
  };
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  const Vector3d point_drift = drift(point) + shift;
  const Pull by_point = pull(point, lower, upper, lower_turn, upper_turn, point_drift);
  const RelativeTurn turn(hinge, lower, upper);
  const double angle_along = turn.rate().dot(against);
  const TurnResponse spring = k.law->at(turn.angle(), k.turn);
  const TurnRates turns = turn_rates(hinge, turn, against);
  const double shear = k.ratios.shear;

  HingeRates rates;
  rates.energy.design = spring.moment() * turns.turn;
  rates.along.design = spring.stiffness * (angle_along * turns.turn + spring.stretch * turns.along);
  rates.energy.design[0] += shear * by_point.energy.dot(hinge.edge);
  rates.along.design[0] += shear * by_point.along.dot(hinge.edge);
  rates.energy.design[3] += shear * by_point.energy.dot(hinge.across);
  rates.along.design[3] += shear * by_point.along.dot(hinge.across);
  rates.energy.turn = spring.energy_k;
  rates.along.turn = spring.moment_k * angle_along;

  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  const Vector3d axis_drift = drift(axis);
  const Pull by_axis = pull(axis, lower, upper, lower_turn, upper_turn, axis_drift);
  const double weight = shear * (k.reach * k.reach);
  rates.energy.design[1] += weight * by_axis.energy.dot(hinge.axis_alpha);
  rates.energy.design[2] += weight * by_axis.energy.dot(hinge.axis_beta);
  rates.along.design[1] += weight * by_axis.along.dot(hinge.axis_alpha);
  rates.along.design[2] += weight * by_axis.along.dot(hinge.axis_beta);
  if (k.reach > 0) {
    rates.energy.reach = 2 * shear * k.reach * axis.gap.squaredNorm();
    rates.along.reach = 4 * shear * k.reach * axis.gap.dot(axis_drift);
  }
  rates.energy.ratios.shear = point.gap.squaredNorm() + k.reach * k.reach * axis.gap.squaredNorm();
  rates.along.ratios.shear = 2 * (point.gap.dot(point_drift) + k.reach * k.reach * axis.gap.dot(axis_drift));
  add_frame_rates(hinge, k, lower, upper, point, axis, along, rates);
  return rates;
}

}  // namespace kinetix::model
