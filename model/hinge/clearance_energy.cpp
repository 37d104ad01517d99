#include "model/hinge/clearance_energy.hpp"

#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

/// Returns the weight across the axis, where axial and shear are equal.
double across_weight(const Stiffness& k) { return (k.ratios.axial + k.ratios.shear) / 2; }

/// E_p as a function of the squared distance, with its first two derivatives.
struct SquareResponse {
  double energy = 0, first = 0, second = 0;
};

SquareResponse by_square(double square, double play) {
  const double d = std::sqrt(std::max(square, 0.0));
  const ClearanceResponse r = clearance_response(d, play);
  if (!(r.force > 0)) return {r.energy, 0, 0};
  return {r.energy, r.force / (2 * d), (r.stiffness - r.force / d) / (4 * d * d)};
}

/// One of the two points of a hinge, with the squares of its gap and of the gap's part along the axis.
class PlayedPoint {
 public:
  PlayedPoint(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
              double edge_mm, double side)
      : gap_(mismatch(hinge, side * k.reach * hinge.axis, lower, upper, edge_mm)),
        along_(gap_, hinge.axis, lower, upper),
        across_weight_(across_weight(k)),
        along_weight_(k.ratios.along),
        across_(by_square(across_square(), k.play)),
        beyond_(by_square(along_.value(), k.play)) {}
  PlayedPoint(const PlayedPoint&) = delete;
  PlayedPoint& operator=(const PlayedPoint&) = delete;

  double across_square() const { return gap_.gap.squaredNorm() - along_.value(); }
  double across_energy() const { return across_.energy + 0.5 * loose_stiffness * gap_.gap.squaredNorm(); }
  double along_energy() const { return beyond_.energy; }
  double energy() const { return across_weight_ * across_energy() + along_weight_ * along_energy(); }

  void add_to(Element& e) const {
    Element whole, part;
    add_turning(gap_, 1, whole);
    add_shifts(gap_, 1, whole);
    along_.add_to(part, 1, true);
    const Vector12 across = whole.gradient - part.gradient;
    e.energy += energy();
    e.gradient += across_weight_ * (across_.first * across + 0.5 * loose_stiffness * whole.gradient) +
                  along_weight_ * beyond_.first * part.gradient;
    e.hessian += across_weight_ *
                 (across_.second * across * across.transpose() +
                  across_.first * (whole.hessian - part.hessian) + 0.5 * loose_stiffness * whole.hessian);
    e.hessian += along_weight_ *
                 (beyond_.second * part.gradient * part.gradient.transpose() + beyond_.first * part.hessian);
  }

  /// Adds the derivatives by one parameter of the energy and of its change along the twists.
  /// @param along change along the twists
  /// @param by, mixed change by the parameter, and by both
  void rate(const DirectedChange& along, const DirectedChange& by, const DirectedChange& mixed,
            double& by_energy, double& by_along) const {
    const double whole = 2 * gap_.gap.dot(by.gap), part = along_.rate(by);
    const double whole_both = 2 * (by.gap.dot(along.gap) + gap_.gap.dot(mixed.gap)),
                 part_both = along_.rate(along, by, mixed);
    const double part_along = along_.rate(along), whole_along = 2 * gap_.gap.dot(along.gap);
    by_energy += across_weight_ * (across_.first * (whole - part) + 0.5 * loose_stiffness * whole) +
                 along_weight_ * beyond_.first * part;
    by_along +=
        across_weight_ * (across_.second * (whole - part) * (whole_along - part_along) +
                          across_.first * (whole_both - part_both) + 0.5 * loose_stiffness * whole_both) +
        along_weight_ * (beyond_.second * part * part_along + beyond_.first * part_both);
  }

  /// Returns the derivative of across_energy() along the twists.
  double across_rate(const DirectedChange& along) const {
    const double whole = 2 * gap_.gap.dot(along.gap);
    return across_.first * (whole - along_.rate(along)) + 0.5 * loose_stiffness * whole;
  }
  double along_rate(const DirectedChange& along) const { return beyond_.first * along_.rate(along); }

  const Mismatch& gap() const { return gap_; }
  const DirectedSquare& along() const { return along_; }

 private:
  static Mismatch mismatch(RestHinge hinge, const Vector3d& shift, const Pose& lower, const Pose& upper,
                           double edge_mm) {
    hinge.lower_arm += shift;
    hinge.upper_arm += shift;
    return point_mismatch(hinge, lower, upper, edge_mm);
  }

  const Mismatch gap_;
  const DirectedSquare along_;  ///< refers to gap_
  const double across_weight_, along_weight_;
  const SquareResponse across_, beyond_;
};

void add_point_gradients(const PlayedPoint& point, const RestHinge& h, double shift, double side,
                         const HingeChanges& changes, HingeGradients& derivatives) {
  const Vector3d zero = Vector3d::Zero();
  const DirectedChange along = changes.along(point.gap(), h.axis, true);
  const auto add = [&](const Vector3d& rest, const Vector3d& axis, double& by_energy, double& by_along) {
    point.rate(along, changes.by(rest, axis), changes.both(rest, axis), by_energy, by_along);
  };
  add(h.edge, zero, derivatives.energy.design[0], derivatives.along.design[0]);
  add(shift * h.axis_alpha, h.axis_alpha, derivatives.energy.design[1], derivatives.along.design[1]);
  add(shift * h.axis_beta, h.axis_beta, derivatives.energy.design[2], derivatives.along.design[2]);
  add(h.across, zero, derivatives.energy.design[3], derivatives.along.design[3]);
  if (shift != 0) add(side * h.axis, zero, derivatives.energy.reach, derivatives.along.reach);
  const auto add_ratios = [](double across, double along_axis, PointRatios& ratios) {
    ratios.axial += across / 2;
    ratios.shear += across / 2;
    ratios.along += along_axis;
  };
  add_ratios(point.across_energy(), point.along_energy(), derivatives.energy.ratios);
  add_ratios(point.across_rate(along), point.along_rate(along), derivatives.along.ratios);
}

}  // namespace

ClearanceResponse clearance_response(double distance, double play) {
  const double width = corner_width * play, beyond = distance - play, into = beyond + width / 2;
  if (!(into > 0)) return {};
  if (into < width) return {into * into * into / (6 * width), into * into / (2 * width), into / width};
  return {0.5 * beyond * beyond + width * width / 24, beyond, 1};
}

double clearance_energy(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                        double edge_mm) {
  return PlayedPoint(hinge, k, lower, upper, edge_mm, -1).energy() +
         PlayedPoint(hinge, k, lower, upper, edge_mm, 1).energy();
}

void add_clearance(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                   double edge_mm, Element& element) {
  for (const double side : {-1.0, 1.0}) PlayedPoint(hinge, k, lower, upper, edge_mm, side).add_to(element);
}

void add_clearance_gradients(const RestHinge& hinge, const Stiffness& k, const Pose& lower, const Pose& upper,
                             double edge_mm, const Vector12& along, HingeGradients& derivatives) {
  const HingeChanges changes(lower, upper, along);
  for (const double side : {-1.0, 1.0})
    add_point_gradients(PlayedPoint(hinge, k, lower, upper, edge_mm, side), hinge, side * k.reach, side,
                        changes, derivatives);
}

std::array<ResistingDistance, 2> resisting_distances(const RestHinge& hinge, const Stiffness& k,
                                                     const Pose& lower, const Pose& upper, double edge_mm,
                                                     double side) {
  const PlayedPoint point(hinge, k, lower, upper, edge_mm, side);
  Element whole;
  add_turning(point.gap(), 1, whole);
  add_shifts(point.gap(), 1, whole);
  const Vector12 along = point.along().gradient(true);
  const auto distance = [](double square, double weight, const Vector12& gradient) -> ResistingDistance {
    const double d = std::sqrt(std::max(square, 0.0));
    if (!(d > 0)) return {0, weight, Vector12::Zero()};
    return {d, weight, gradient / (2 * d)};
  };
  return {distance(point.across_square(), across_weight(k), whole.gradient - along),
          distance(point.along().value(), k.ratios.along, along)};
}

}  // namespace kinetix::model
