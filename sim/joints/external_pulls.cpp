#include "sim/joints/external_pulls.hpp"

#include <Eigen/Geometry>
#include <utility>

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
constexpr double hold_weight = 100;

Vector3d reach(const Grasp& grasp, const model::Pose& pose, double edge_mm) {
  const Vector3d way = grasp.to - (pose.p / edge_mm + pose.R * grasp.arm);
  return way.norm() > longest_reach ? Vector3d(longest_reach * way.normalized()) : way;
}

VelocityRow row(int body, const Vector3d& linear, const Vector3d& angular, double target, double weight) {
  VelocityRow out{body, -1, Vector6::Zero(), Vector6::Zero(), target, weight};
  out.first << linear, angular;
  return out;
}

}  // namespace

Vector3d Hand::pull(const model::State& state) const {
  if (grasps.empty()) return Vector3d::Zero();
  const Grasp& grasp = grasps.front();
  return grasp.stiffness * reach(grasp, state[grasp.body], edge_mm_);
}

std::vector<VelocityRow> Hand::rows(const model::State& state, const std::vector<model::Twist>& speeds,
                                    double step) const {
  std::vector<VelocityRow> rows;
  for (const Grasp& grasp : grasps) append(grasp, state[grasp.body], speeds[grasp.body], step, rows);
  for (const Hold& hold : holds) append(hold, state[hold.body], speeds[hold.body], step, rows);
  return rows;
}

void Hand::append(const Grasp& grasp, const model::Pose& pose, const model::Twist& speed, double step,
                  std::vector<VelocityRow>& rows) const {
  const Vector3d arm = pose.R * grasp.arm;
  const Vector3d change = reach(grasp, pose, edge_mm_) / step - (speed.v + speed.omega.cross(arm));
  const double weight = grasp.stiffness * step * step / joint_stiffness_;
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = Vector3d::Unit(k);
    rows.push_back(row(grasp.body, axis, arm.cross(axis), change[k], weight));
  }
}

void Hand::append(const Hold& hold, const model::Pose& pose, const model::Twist& speed, double step,
                  std::vector<VelocityRow>& rows) const {
  const Vector3d shift = (hold.place.p - pose.p) / edge_mm_ / step - speed.v;
  const Eigen::AngleAxisd back(hold.place.R * pose.R.transpose());
  const Vector3d turn = back.angle() * back.axis() / step - speed.omega;
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = Vector3d::Unit(k);
    rows.push_back(row(hold.body, axis, Vector3d::Zero(), shift[k], hold_weight));
    rows.push_back(row(hold.body, Vector3d::Zero(), axis, turn[k], hold_weight));
  }
}

}  // namespace kinetix::sim
