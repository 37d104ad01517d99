#include "sim/joints/elastic_hinges.hpp"

#include "model/base/decompositions.hpp"
#include "model/closure/closure.hpp"
#include "model/linkage/hinge_mismatch.hpp"
#include "sim/joints/framed_points.hpp"

namespace kinetix::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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

}  // namespace kinetix::sim
