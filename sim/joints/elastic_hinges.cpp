#include "sim/joints/elastic_hinges.hpp"

#include <cmath>

#include "model/base/decompositions.hpp"
#include "model/hinge/clearance_energy.hpp"

namespace kinetix::sim {
namespace {

using Eigen::Vector3d;

Vector3d rest_direction(const model::RestHinge& hinge) {
  return (hinge.edge - hinge.edge.dot(hinge.axis) * hinge.axis).normalized();
}

/// Constraint point: arms from the bodies' vertices to it, and the gap, lower minus upper; cell edges.
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

/// Returns the row of the gap along the direction carried by both bodies, which turns with them.
VelocityRow carried_row(const Point& point, const Vector3d& lower, const Vector3d& upper) {
  const Vector3d sum = lower + upper, direction = sum.normalized();
  VelocityRow row = fixed_row(point, direction);
  const Vector3d aside = (point.gap - point.gap.dot(direction) * direction) / sum.norm();
  row.first.tail<3>() += lower.cross(aside);
  row.second.tail<3>() += upper.cross(aside);
  return row;
}

/// Makes the row an undamped spring by implicit Euler. @param stretch of the spring, along the row
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

namespace {

/// Returns the derivative of the energy of a point with clearance by its gap. @param side -1 or 1
Vector3d played_point_pull(const model::RestHinge& hinge, const model::Stiffness& k, const model::Pose& lower,
                           const model::Pose& upper, double edge_mm, double side) {
  const Vector3d gap = point_of(hinge, side * k.reach, edge_mm, lower, upper).gap,
                 axis = hinge_directions(hinge, lower, upper).axis;
  const Vector3d along = gap.dot(axis) * axis, across = gap - along;
  const auto pull = [&](const Vector3d& part) -> Vector3d {
    const double force = model::clearance_response(part.norm(), k.play).force;
    return force > 0 ? Vector3d(force * part.normalized()) : Vector3d::Zero();
  };
  return k.ratios.shear * (pull(across) + model::loose_stiffness * gap) + k.ratios.along * pull(along);
}

HingePull played_pull(const model::RestHinge& hinge, const model::Stiffness& k, const model::Pose& lower,
                      const model::Pose& upper, double edge_mm) {
  const Vector3d below = played_point_pull(hinge, k, lower, upper, edge_mm, -1),
                 above = played_point_pull(hinge, k, lower, upper, edge_mm, 1);
  HingePull pull;
  pull.point = above + below;
  pull.axis = k.reach * (above - below);
  return pull;
}

/// Rows of the springs of one hinge.
class Springs {
 public:
  Springs(const model::RestHinge& hinge, const model::State& state, const std::vector<model::Twist>& speeds,
          double step, std::vector<VelocityRow>& rows)
      : hinge_(hinge),
        lower_(state[hinge.lower]),
        upper_(state[hinge.upper]),
        lower_speed_(speeds[hinge.lower]),
        upper_speed_(speeds[hinge.upper]),
        step_(step),
        rows_(rows),
        at_(hinge_directions(hinge, lower_, upper_)),
        wall_(rest_direction(hinge)) {}

  void add_two_points(const model::Stiffness& k, double edge_mm) {
    for (const double side : {-k.reach, k.reach}) {
      const Point point = point_of(hinge_, side, edge_mm, lower_, upper_);
      add_in_space(point, k.ratios.shear);
      add_along(point, wall_, at_.wall, k.ratios.axial - k.ratios.shear);
      add_along(point, hinge_.axis, at_.axis, k.ratios.along - k.ratios.shear);
    }
  }

  void add_point_and_axis(const model::Stiffness& k, double edge_mm) {
    const Point point = point_of(hinge_, 0, edge_mm, lower_, upper_);
    add_in_space(point, 2 * k.ratios.shear);
    add_along(point, wall_, at_.wall, 2 * (k.ratios.axial - k.ratios.shear));
    add_along(point, hinge_.axis, at_.axis, 2 * (k.ratios.along - k.ratios.shear));
    const model::Mismatch m = model::axis_mismatch(hinge_, lower_, upper_);
    const Point axis{m.lower, m.upper, m.gap};
    turning_ = true;
    add_in_space(axis, 2 * k.twist_weight());
    add_along(axis, wall_, at_.wall, 2 * k.rock_beyond_twist());
    turning_ = false;
  }

  void add_played(const model::Stiffness& k, double edge_mm) {
    for (const double side : {-1.0, 1.0}) {
      const Point point = point_of(hinge_, side * k.reach, edge_mm, lower_, upper_);
      add_in_space(point, model::loose_stiffness * k.ratios.shear);
      const auto distances = resisting_distances(hinge_, k, lower_, upper_, edge_mm, side);
      for (const model::ResistingDistance& d : distances) add_beyond(d, k.play);
      add_brake(point, distances[0], k.play);
    }
  }

 private:
  void add_in_space(const Point& point, double weight) {
    for (int c = 0; c < 3; ++c) add(fixed_row(point, Vector3d::Unit(c)), point.gap[c], weight);
  }
  void add_along(const Point& point, const Vector3d& rest, const Vector3d& direction, double weight) {
    add(carried_row(point, lower_.R * rest, upper_.R * rest), point.gap.dot(direction), weight);
  }
  void add_beyond(const model::ResistingDistance& d, double play) {
    const model::ClearanceResponse response = model::clearance_response(d.distance, play);
    if (!(response.stiffness > 0)) return;
    VelocityRow row;
    row.first << d.gradient.segment<3>(3), d.gradient.segment<3>(0);
    row.second << d.gradient.segment<3>(9), d.gradient.segment<3>(6);
    add(row, response.force / response.stiffness, d.weight * response.stiffness);
  }
  /// Adds the brake: a force of constant size resists its own turning.
  void add_brake(const Point& point, const model::ResistingDistance& across, double play) {
    const double force = model::clearance_response(across.distance, play).force;
    if (!(force > 0)) return;
    add(fixed_row(point, at_.axis.cross(point.gap).normalized()), 0, across.weight * force / across.distance);
  }
  void add(VelocityRow row, double stretch, double weight) {
    row.a = hinge_.lower;
    row.b = hinge_.upper;
    if (turning_) row.first.head<3>() = row.second.head<3>() = Vector3d::Zero();
    aim(row, stretch, weight, lower_speed_, upper_speed_, step_);
    rows_.push_back(row);
  }

  const model::RestHinge& hinge_;
  const model::Pose &lower_, &upper_;
  const model::Twist &lower_speed_, &upper_speed_;
  const double step_;
  std::vector<VelocityRow>& rows_;
  const HingeDirections at_;
  const Vector3d wall_;
  bool turning_ = false;  ///< rows of an axis, which translations do not change
};

}  // namespace

HingePull hinge_pull(const model::RestHinge& hinge, const model::Stiffness& k, const model::Pose& lower,
                     const model::Pose& upper, double edge_mm) {
  if (k.play > 0) return played_pull(hinge, k, lower, upper, edge_mm);
  const Vector3d point = model::point_mismatch(hinge, lower, upper, edge_mm).gap,
                 axis = model::axis_mismatch(hinge, lower, upper).gap;
  HingePull pull;
  pull.point = 2 * k.ratios.shear * point;
  pull.axis = 2 * k.twist_weight() * axis;
  if (!k.framed()) return pull;
  const HingeDirections at = hinge_directions(hinge, lower, upper);
  pull.framed_point = 2 * (k.ratios.axial - k.ratios.shear) * point.dot(at.wall) * at.wall +
                      2 * (k.ratios.along - k.ratios.shear) * point.dot(at.axis) * at.axis;
  pull.framed_axis = 2 * k.rock_beyond_twist() * axis.dot(at.wall) * at.wall;
  pull.point += pull.framed_point;
  pull.axis += pull.framed_axis;
  return pull;
}

void append_framed_points(const model::RestHinge& hinge, const model::Stiffness& stiffness, double edge_mm,
                          const model::State& state, const std::vector<model::Twist>& speeds, double step,
                          std::vector<VelocityRow>& rows) {
  Springs springs(hinge, state, speeds, step, rows);
  if (stiffness.play > 0)
    springs.add_played(stiffness, edge_mm);
  else if (stiffness.tilt.are_by_reach())
    springs.add_two_points(stiffness, edge_mm);
  else
    springs.add_point_and_axis(stiffness, edge_mm);
}

namespace {

using Eigen::Matrix3d;

/// Returns the second derivative of force . arm by a turn of the arm.
Matrix3d turned(const Vector3d& force, const Vector3d& arm) {
  const Matrix3d product = force * arm.transpose();
  return 0.5 * (product + product.transpose()) - product.trace() * Matrix3d::Identity();
}

/// Returns the resistance of the points' forces to turns of each body, over k_point. Forces in a hinge's
/// frame turn with both its bodies. They act in the middle of the mismatch, so they neither resist nor drive
/// a turn of the whole.
std::vector<Matrix3d> turning_stiffness(const model::Linkage& structure, const model::State& state,
                                        const model::Stiffness& stiffness) {
  std::vector<Matrix3d> sums(state.size(), Matrix3d::Zero());
  for (std::size_t h = 0; h < structure.hinges.size(); ++h) {
    const model::RestHinge& hinge = structure.hinges[h];
    const model::Stiffness& k = stiffness.of(h);
    const Matrix3d &lower = state[hinge.lower].R, &upper = state[hinge.upper].R;
    const HingePull pull =
        hinge_pull(hinge, k, state[hinge.lower], state[hinge.upper], structure.size.edge_mm);
    sums[hinge.lower] += turned(pull.point, lower * hinge.lower_arm) + turned(pull.axis, lower * hinge.axis);
    sums[hinge.upper] -= turned(pull.point, upper * hinge.upper_arm) + turned(pull.axis, upper * hinge.axis);
    if (!k.framed()) continue;
    const auto middle = [&](const Vector3d& force, const Vector3d& mismatch) -> Matrix3d {
      return 0.5 * turned(force, mismatch);
    };
    const Matrix3d shifted =
        middle(pull.framed_point,
               point_mismatch(hinge, state[hinge.lower], state[hinge.upper], structure.size.edge_mm).gap) +
        middle(pull.framed_axis, axis_mismatch(hinge, state[hinge.lower], state[hinge.upper]).gap);
    sums[hinge.lower] -= shifted;
    sums[hinge.upper] -= shifted;
  }
  return sums;
}

VelocityRow brake(int body, const Vector3d& direction, double weight, const Vector3d& speed) {
  VelocityRow row{body, -1, Vector6::Zero(), Vector6::Zero(), -direction.dot(speed), weight};
  row.first.tail<3>() = direction;
  return row;
}

}  // namespace

ElasticHinges::ElasticHinges(const model::Linkage& structure, const model::Stiffness& stiffness)
    : structure_(structure), stiffness_(stiffness) {
  stiffness.check_count(structure.hinges.size());
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h)
    springs_.push_back({{h, 0}, stiffness.of(h).law, stiffness.of(h).turn});
}

void ElasticHinges::drive_to(int hinge, double angle, double weight) {
  springs_.resize(structure_.hinges.size());
  springs_.push_back({{hinge, angle}, model::linear_hinge(), weight});
}

void ElasticHinges::add_springs(const std::vector<int>& hinges, const std::vector<double>& angles,
                                double weight) {
  springs_.resize(structure_.hinges.size());
  for (std::size_t k = 0; k < hinges.size(); ++k)
    springs_.push_back({{hinges[k], angles[k]}, model::linear_hinge(), weight});
}

void ElasticHinges::relax_at(const std::vector<double>& angles) {
  for (std::size_t h = 0; h < angles.size(); ++h) springs_[h].goal.angle = angles[h];
}

VelocityRow ElasticHinges::row(const Spring& spring, const model::State& state,
                               const std::vector<model::Twist>& speeds, double step) const {
  const model::RestHinge& hinge = structure_.hinges[spring.goal.hinge];
  std::vector<Eigen::Triplet<double>> entries;
  append_drive_gradient(spring.goal, structure_, state, 0, entries);
  const Vector3d gradient(entries[0].value(), entries[1].value(), entries[2].value());
  const model::TurnResponse response =
      spring.law->at(drive_residual(spring.goal, structure_, state), spring.weight);
  VelocityRow row{hinge.lower, hinge.upper, Vector6::Zero(), Vector6::Zero(), 0, response.stiffness};
  row.first.tail<3>() = -gradient;
  row.second.tail<3>() = gradient;
  row.target = -response.stretch / step - gradient.dot(speeds[hinge.upper].omega - speeds[hinge.lower].omega);
  return row;
}

std::vector<VelocityRow> ElasticHinges::rows(const model::State& state,
                                             const std::vector<model::Twist>& speeds, double step) const {
  std::vector<VelocityRow> rows;
  rows.reserve(springs_.size() + 3 * state.size());
  for (const Spring& spring : springs_) rows.push_back(row(spring, state, speeds, step));
  const std::vector<Matrix3d> stiffness = turning_stiffness(structure_, state, stiffness_);
  for (std::size_t b = 0; b < state.size(); ++b) {
    const PrincipalAxes modes = principal_axes(stiffness[b]);
    for (int k = 0; k < 3; ++k)
      rows.push_back(brake(static_cast<int>(b), modes.axes.col(k), modes.values[k], speeds[b].omega));
  }
  for (std::size_t h = 0; h < structure_.hinges.size(); ++h)
    if (stiffness_.of(h).framed())
      append_framed_points(structure_.hinges[h], stiffness_.of(h), structure_.size.edge_mm, state, speeds,
                           step, rows);
  return rows;
}

double largest_hinge_force(const model::Linkage& structure, const model::State& state,
                           const model::Stiffness& stiffness) {
  double largest = 0;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const model::Stiffness& k = stiffness.of(h);
    const model::RestHinge& hinge = structure.hinges[h];
    const HingePull pull =
        hinge_pull(hinge, k, state[hinge.lower], state[hinge.upper], structure.size.edge_mm);
    const Eigen::Vector3d point = pull.point / 2, lever = pull.axis / (2 * k.reach);
    const double turn = k.law->at(hinge_turn(structure, state, h), k.turn).moment();
    largest = std::max({largest, (point + lever).norm(), (point - lever).norm(), std::abs(turn)});
  }
  return largest;
}

}  // namespace kinetix::sim
