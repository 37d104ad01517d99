#include "sim/framed_points.hpp"

#include <Eigen/Geometry>

namespace kinetix::sim {
namespace {

using Eigen::Vector3d;

Vector3d rest_direction(const model::RestHinge& hinge) {
  return (hinge.edge - hinge.edge.dot(hinge.axis) * hinge.axis).normalized();
}

/// A constraint point: arms from the bodies' vertices to it, and the gap, lower less upper; cell edges.
struct Point {
  Vector3d lower, upper, gap;
};

Point point_of(const model::RestHinge& hinge, double along_axis, double edge_mm, const model::Pose& lower,
               const model::Pose& upper) {
  const Vector3d shift = along_axis * hinge.axis;
  Point p{lower.R * (hinge.lower_arm + shift), upper.R * (hinge.upper_arm + shift), Vector3d::Zero()};
  p.gap = (lower.p - upper.p) / edge_mm + p.lower - p.upper;
  return p;
}

VelocityRow fixed_row(const Point& point, const Vector3d& direction) {
  VelocityRow row;
  row.first << direction, point.lower.cross(direction);
  row.second << -direction, -point.upper.cross(direction);
  return row;
}

/// Of the gap along what both bodies carry, which turns with them.
VelocityRow carried_row(const Point& point, const Vector3d& lower, const Vector3d& upper) {
  const Vector3d sum = lower + upper, direction = sum.normalized();
  VelocityRow row = fixed_row(point, direction);
  const Vector3d aside = (point.gap - point.gap.dot(direction) * direction) / sum.norm();
  row.first.tail<3>() += lower.cross(aside);
  row.second.tail<3>() += upper.cross(aside);
  return row;
}

/// An undamped spring by implicit Euler. @param stretch of it, along the row
void aim(VelocityRow& row, double stretch, double weight, const model::Twist& a, const model::Twist& b,
         double step) {
  const auto along = [](const Vector6& direction, const model::Twist& speed) {
    return direction.head<3>().dot(speed.v) + direction.tail<3>().dot(speed.omega);
  };
  row.weight = weight;
  row.target = -stretch / step - along(row.first, a) - along(row.second, b);
}

}  // namespace

HingeDirections hinge_directions(const model::RestHinge& hinge, const model::Pose& lower,
                                 const model::Pose& upper) {
  const Vector3d rest = rest_direction(hinge);
  return {(lower.R * rest + upper.R * rest).normalized(),
          (lower.R * hinge.axis + upper.R * hinge.axis).normalized()};
}

Vector3d pull(const model::PointRatios& ratios, const HingeDirections& at, const Vector3d& gap) {
  if (ratios.are_one()) return gap;
  return ratios.shear * gap + (ratios.axial - ratios.shear) * gap.dot(at.wall) * at.wall +
         (ratios.along - ratios.shear) * gap.dot(at.axis) * at.axis;
}

void append_framed_points(const model::RestHinge& hinge, const model::Stiffness& stiffness, double edge_mm,
                          const model::State& state, const std::vector<model::Twist>& speeds, double step,
                          std::vector<VelocityRow>& rows) {
  const model::Pose &lower = state[hinge.lower], &upper = state[hinge.upper];
  const HingeDirections at = hinge_directions(hinge, lower, upper);
  const Vector3d wall = rest_direction(hinge);
  const model::PointRatios& k = stiffness.ratios;
  const auto add = [&](VelocityRow row, double stretch, double weight) {
    row.a = hinge.lower;
    row.b = hinge.upper;
    aim(row, stretch, weight, speeds[hinge.lower], speeds[hinge.upper], step);
    rows.push_back(row);
  };
  for (const double side : {-stiffness.reach, stiffness.reach}) {
    const Point point = point_of(hinge, side, edge_mm, lower, upper);
    for (int c = 0; c < 3; ++c) add(fixed_row(point, Vector3d::Unit(c)), point.gap[c], k.shear);
    add(carried_row(point, lower.R * wall, upper.R * wall), point.gap.dot(at.wall), k.axial - k.shear);
    add(carried_row(point, lower.R * hinge.axis, upper.R * hinge.axis), point.gap.dot(at.axis),
        k.along - k.shear);
  }
}

}  // namespace kinetix::sim
