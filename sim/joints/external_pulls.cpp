#include "sim/joints/external_pulls.hpp"

#include "model/elastic/cord_element.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::sim {

Cord::Cord(const model::Linkage& structure, std::vector<int> through)
    : structure_(structure), through_(std::move(through)), goal_(0) {
  goal_ = cord_length(structure, through_, rest_state(structure)) / structure.size.edge_mm;
}

double Cord::excess(const model::State& state) const {
  return cord_length(structure_, through_, state) / structure_.size.edge_mm - goal_;
}

Eigen::VectorXd Cord::pull(const model::State& state) const {
  const Eigen::VectorXd gradient = cord_gradient(structure_, through_, state);
  Eigen::VectorXd pull(gradient.size());
  for (Eigen::Index k = 0; k < gradient.size(); k += 6)
    pull.segment<6>(k) << -gradient.segment<3>(k + 3), -gradient.segment<3>(k);
  return pull;
}

namespace {

using Eigen::Vector3d;

// Cell edges: a hand further away pulls no harder, so that it does not tear the sheet.
constexpr double longest_reach = 5;
// Over the joints: far stiffer than a hinge.
constexpr double fixed_weight = 100;

Vector3d reach(const SpringPull& spring_pull, const model::Pose& pose, double edge_mm) {
  const Vector3d distance = spring_pull.to - (pose.p / edge_mm + pose.R * spring_pull.arm);
  return distance.norm() > longest_reach ? Vector3d(longest_reach * distance.normalized()) : distance;
}

VelocityRow row(int body, const Vector3d& linear, const Vector3d& angular, double target, double weight) {
  VelocityRow out{body, -1, Vector6::Zero(), Vector6::Zero(), target, weight};
  out.first << linear, angular;
  return out;
}

}  // namespace

Vector3d ExternalPulls::pull(const model::State& state) const {
  if (spring_pulls.empty()) return Vector3d::Zero();
  const SpringPull& spring_pull = spring_pulls.front();
  return spring_pull.stiffness * reach(spring_pull, state[spring_pull.body], edge_mm_);
}

std::vector<VelocityRow> ExternalPulls::rows(const model::State& state,
                                             const std::vector<model::Twist>& speeds, double step) const {
  std::vector<VelocityRow> rows;
  for (const SpringPull& spring_pull : spring_pulls)
    append(spring_pull, state[spring_pull.body], speeds[spring_pull.body], step, rows);
  for (const FixedBody& fixed : fixed_bodies)
    append(fixed, state[fixed.body], speeds[fixed.body], step, rows);
  return rows;
}

void ExternalPulls::append(const SpringPull& spring_pull, const model::Pose& pose, const model::Twist& speed,
                           double step, std::vector<VelocityRow>& rows) const {
  const Vector3d arm = pose.R * spring_pull.arm;
  const Vector3d change = reach(spring_pull, pose, edge_mm_) / step - (speed.v + speed.omega.cross(arm));
  const double weight = spring_pull.stiffness * step * step / joint_stiffness_;
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = Vector3d::Unit(k);
    rows.push_back(row(spring_pull.body, axis, arm.cross(axis), change[k], weight));
  }
}

void ExternalPulls::append(const FixedBody& fixed, const model::Pose& pose, const model::Twist& speed,
                           double step, std::vector<VelocityRow>& rows) const {
  const Vector3d shift = (fixed.place.p - pose.p) / edge_mm_ / step - speed.v;
  const Eigen::AngleAxisd back(fixed.place.R * pose.R.transpose());
  const Vector3d turn = back.angle() * back.axis() / step - speed.omega;
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = Vector3d::Unit(k);
    rows.push_back(row(fixed.body, axis, Vector3d::Zero(), shift[k], fixed_weight));
    rows.push_back(row(fixed.body, Vector3d::Zero(), axis, turn[k], fixed_weight));
  }
}

}  // namespace kinetix::sim
