#include "model/hinge/hinge_energy.hpp"

#include <cmath>

#include "model/hinge/clearance_energy.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

/// Derivatives of |gap|^2, and of its change along twists, by the rest vector that both bodies carry.
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

/// Energy terms along the directions of the hinge's frame, in addition to springs of shear stiffness in all
/// directions. The axis has no mismatch along itself, since both bodies carry a unit vector.
class FrameTerms {
 public:
  FrameTerms(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
             const Mismatch& point, const Mismatch& axis)
      : axial(k.ratios.axial - k.ratios.shear),
        along(k.ratios.along - k.ratios.shear),
        rock(k.rock_beyond_twist()),
        wall(wall_direction(hinge)),
        point_axial(point, wall, lower, upper),
        point_along(point, hinge.axis, lower, upper),
        axis_axial(axis, wall, lower, upper) {}

  double energy() const {
    return axial * point_axial.value() + rock * axis_axial.value() + along * point_along.value();
  }
  Vector12 gradient() const {
    Vector12 g = axial * point_axial.gradient(true) + along * point_along.gradient(true);
    if (rock != 0) g += rock * axis_axial.gradient(false);
    return g;
  }
  void add_to(Element& e) const {
    point_axial.add_to(e, axial, true);
    point_along.add_to(e, along, true);
    if (rock != 0) axis_axial.add_to(e, rock, false);
  }

  const double axial, along;  ///< ratios minus shear, see PointRatios
  const double rock;          ///< Stiffness::rock_beyond_twist()

  const Vector3d wall;  ///< unit vector at rest
  const DirectedSquare point_axial, point_along, axis_axial;
};

}  // namespace

HingeEnergy hinge_energy(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                         double edge_mm) {
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  const double angle = RelativeTurn(hinge, lower, upper).angle();
  const double turn = k.law->at(angle, k.turn).energy;
  if (k.play > 0) return {clearance_energy(hinge, k, lower, upper, edge_mm), turn};
  if (!k.framed() && !k.tilts()) return {point.gap.squaredNorm(), turn};
  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  const double stretch = k.ratios.shear * point.gap.squaredNorm() + k.twist_weight() * axis.gap.squaredNorm();
  if (!k.framed()) return {stretch, turn};
  return {stretch + FrameTerms(hinge, k, lower, upper, point, axis).energy(), turn};
}

namespace {

/// Adds the stretch energy of a hinge without clearance.
void add_stretch(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                 double edge_mm, Element& e) {
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  add_turning(point, k.ratios.shear, e);
  add_shifts(point, k.ratios.shear, e);
  if (!k.tilts() && !k.framed()) return;
  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  if (k.tilts()) add_turning(axis, k.twist_weight(), e);
  if (k.framed()) FrameTerms(hinge, k, lower, upper, point, axis).add_to(e);
}

}  // namespace

Element hinge_element(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                      double edge_mm) {
  Element e;
  if (k.play > 0)
    add_clearance(hinge, k, lower, upper, edge_mm, e);
  else
    add_stretch(hinge, k, lower, upper, edge_mm, e);
  const Element turn = RelativeTurn(hinge, lower, upper).element();
  const TurnResponse spring = k.law->at(turn.energy, k.turn);
  e.energy += spring.energy;
  e.gradient += spring.moment() * turn.gradient;
  e.hessian += spring.stiffness * (spring.stretch * turn.hessian + turn.gradient * turn.gradient.transpose());
  return e;
}

Vector12 hinge_gradient(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                        double edge_mm) {
  if (k.play > 0) return hinge_element(hinge, k, lower, upper, edge_mm).gradient;
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  const RelativeTurn turn(hinge, lower, upper);
  const Vector3d moment = k.law->at(turn.angle(), k.turn).moment() * turn.rate_in_space();
  const double twice = 2 * k.ratios.shear;
  Vector12 g;
  g << twice * point.lower.cross(point.gap) - moment, twice * point.gap,
      moment - twice * point.upper.cross(point.gap), -twice * point.gap;
  if (!k.tilts() && !k.framed()) return g;
  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  const double weight = 2 * k.twist_weight();
  g.segment<3>(0) += weight * axis.lower.cross(axis.gap);
  g.segment<3>(6) -= weight * axis.upper.cross(axis.gap);
  if (k.framed()) g += FrameTerms(hinge, k, lower, upper, point, axis).gradient();
  return g;
}

namespace {

/// Value of a DirectedSquare, its derivative along twists, and the derivatives of both by the design.
struct SquareGradients {
  double value = 0, along = 0;
  DesignGradient value_design = DesignGradient::Zero(), along_design = DesignGradient::Zero();
};

/// @param rest, w changes of the carried vectors by t, alpha, beta and offset: see HingeChanges::by
void add_design(const DirectedSquare& square, const DirectedChange& along, const HingeChanges& changes,
                const std::array<Vector3d, 4>& rest, const std::array<Vector3d, 4>& w, SquareGradients& out) {
  for (int k = 0; k < 4; ++k) {
    const DirectedChange by = changes.by(rest[k], w[k]);
    out.value_design[k] = square.rate(by);
    out.along_design[k] = square.rate(along, by, changes.both(rest[k], w[k]));
  }
}

void add(double weight, const SquareGradients& square, HingeGradients& derivatives) {
  derivatives.energy.design += weight * square.value_design;
  derivatives.along.design += weight * square.along_design;
}

/// Adds the derivatives of FrameTerms. On entry, the derivatives by shear and by twist assume equal stiffness
/// in all directions.
void add_frame_gradients(const RestHinge& h, const Stiffness& k, const Pose& lower, const Pose& upper,
                         const Mismatch& point, const Mismatch& axis, const Vector12& along,
                         HingeGradients& derivatives) {
  const FrameTerms frame(h, k, lower, upper, point, axis);
  const HingeChanges changes(lower, upper, along);
  const Vector3d wall = wall_direction(h);
  const DirectedChange by_axial = changes.along(point, wall, true),
                       by_along = changes.along(point, h.axis, true),
                       by_tilt = changes.along(axis, wall, false);
  SquareGradients point_axial{frame.point_axial.value(), frame.point_axial.rate(by_axial)},
      point_along{frame.point_along.value(), frame.point_along.rate(by_along)},
      tilt{frame.axis_axial.value(), frame.axis_axial.rate(by_tilt)};
  if (k.framed()) {
    const Vector3d zero = Vector3d::Zero();
    const std::array<Vector3d, 4> arms{h.edge, zero, zero, h.across},
        axes{zero, h.axis_alpha, h.axis_beta, zero},
        walls{zero, wall_direction_rate(h, h.axis_alpha), wall_direction_rate(h, h.axis_beta), zero};
    add_design(frame.point_axial, by_axial, changes, arms, walls, point_axial);
    add_design(frame.point_along, by_along, changes, arms, axes, point_along);
    add_design(frame.axis_axial, by_tilt, changes, axes, walls, tilt);
    add(frame.axial, point_axial, derivatives);
    add(frame.along, point_along, derivatives);
    add(frame.rock, tilt, derivatives);
  }
  const auto add_ratios = [](double axial, double shear_axis, double rock, HingeGradient& rate) {
    rate.ratios = {axial, rate.ratios.shear - axial - shear_axis, shear_axis};
    rate.rock = rock / 2;
    rate.twist -= rock / 2;
  };
  add_ratios(point_axial.value, point_along.value, tilt.value, derivatives.energy);
  add_ratios(point_axial.along, point_along.along, tilt.along, derivatives.along);
}

/// Distributes the derivatives by rock and twist. If the hinge does not give one of them, it belongs to the
/// reach and to the point stiffnesses that define it.
void share_tilt(const Stiffness& k, HingeGradient& rate) {
  const double squared = k.reach * k.reach;
  if (!k.tilt.rock) {
    rate.ratios.axial += 2 * squared * rate.rock;
    if (k.reach > 0) rate.reach += 4 * k.reach * k.ratios.axial * rate.rock;
    rate.rock = 0;
  }
  if (!k.tilt.twist) {
    rate.ratios.shear += 2 * squared * rate.twist;
    if (k.reach > 0) rate.reach += 4 * k.reach * k.ratios.shear * rate.twist;
    rate.twist = 0;
  }
}

}  // namespace

namespace {

/// Returns the derivatives of the turning spring.
HingeGradients spring_gradients(const RestHinge& hinge, const Stiffness& k, const Pose& lower,
                                const Pose& upper, const Vector12& along) {
  const Vector3d against = upper.R.transpose() * (along.segment<3>(6) - along.segment<3>(0));
  const RelativeTurn turn(hinge, lower, upper);
  const double angle_along = turn.rate().dot(against);
  const TurnResponse spring = k.law->at(turn.angle(), k.turn);
  const TurnGradients turns = turn_gradients(hinge, turn, against);
  HingeGradients derivatives;
  derivatives.energy.design = spring.moment() * turns.turn;
  derivatives.along.design = spring.stiffness * (angle_along * turns.turn + spring.stretch * turns.along);
  derivatives.energy.turn = spring.energy_k;
  derivatives.along.turn = spring.moment_k * angle_along;
  return derivatives;
}

/// Adds the derivatives of the stretch of a hinge without clearance.
void add_stretch_gradients(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                           double edge_mm, const Vector12& along, HingeGradients& derivatives) {
  const Vector3d lower_turn = along.segment<3>(0), upper_turn = along.segment<3>(6),
                 shift = along.segment<3>(3) - along.segment<3>(9);
  const auto drift = [&](const Mismatch& m) -> Vector3d {
    return lower_turn.cross(m.lower) - upper_turn.cross(m.upper);
  };
  const Mismatch point = point_mismatch(hinge, lower, upper, edge_mm);
  const Vector3d point_drift = drift(point) + shift;
  const Pull by_point = pull(point, lower, upper, lower_turn, upper_turn, point_drift);
  const double shear = k.ratios.shear;
  derivatives.energy.design[0] += shear * by_point.energy.dot(hinge.edge);
  derivatives.along.design[0] += shear * by_point.along.dot(hinge.edge);
  derivatives.energy.design[3] += shear * by_point.energy.dot(hinge.across);
  derivatives.along.design[3] += shear * by_point.along.dot(hinge.across);

  const Mismatch axis = axis_mismatch(hinge, lower, upper);
  const Vector3d axis_drift = drift(axis);
  const Pull by_axis = pull(axis, lower, upper, lower_turn, upper_turn, axis_drift);
  const double weight = k.twist_weight();
  derivatives.energy.design[1] += weight * by_axis.energy.dot(hinge.axis_alpha);
  derivatives.energy.design[2] += weight * by_axis.energy.dot(hinge.axis_beta);
  derivatives.along.design[1] += weight * by_axis.along.dot(hinge.axis_alpha);
  derivatives.along.design[2] += weight * by_axis.along.dot(hinge.axis_beta);
  derivatives.energy.ratios.shear = point.gap.squaredNorm();
  derivatives.along.ratios.shear = 2 * point.gap.dot(point_drift);
  derivatives.energy.twist = axis.gap.squaredNorm() / 2;
  derivatives.along.twist = axis.gap.dot(axis_drift);
  add_frame_gradients(hinge, k, lower, upper, point, axis, along, derivatives);
  share_tilt(k, derivatives.energy);
  share_tilt(k, derivatives.along);
}

}  // namespace

HingeGradients hinge_gradients(const RestHinge& hinge, const Stiffness& k, const Pose& lower,
                               const Pose& upper, double edge_mm, const Vector12& along) {
  HingeGradients derivatives = spring_gradients(hinge, k, lower, upper, along);
  if (k.play > 0)
    add_clearance_gradients(hinge, k, lower, upper, edge_mm, along, derivatives);
  else
    add_stretch_gradients(hinge, k, lower, upper, edge_mm, along, derivatives);
  return derivatives;
}

}  // namespace kinetix::model
