#include "model/linkage/state.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace kinetix::model {
namespace {

Eigen::Matrix3Xd positions(const State& state) {
  Eigen::Matrix3Xd points(3, state.size());
  for (std::size_t b = 0; b < state.size(); ++b) points.col(b) = state[b].p;
  return points;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

State rest_state(const Linkage& structure) {
  State state(structure.bodies.size());
  for (std::size_t b = 0; b < state.size(); ++b) state[b].p = structure.rest_position(static_cast<int>(b));
  return state;
}

bool is_finite(const State& state) {
  return std::all_of(state.begin(), state.end(),
                     [](const Pose& pose) { return pose.R.allFinite() && pose.p.allFinite(); });
}

HingeGaps hinge_gaps(const Linkage& structure, const State& state) {
  HingeGaps gaps;
  double sum = 0;
  for (std::size_t k = 0; k < structure.hinges.size(); ++k) {
    const RestHinge& hinge = structure.hinges[k];
    const Pose& lower = state[hinge.lower];
    const Pose& upper = state[hinge.upper];
    const double gap = point_mismatch(hinge, lower, upper, structure.size.edge_mm).gap.norm();
    const double axis_gap = hinge.ball ? 0 : angle_between(lower.R * hinge.axis, upper.R * hinge.axis);
    sum += gap * gap;
    if (gaps.worst_hinge < 0 || !(gap <= gaps.max)) {
      gaps.max = gap;
      gaps.worst_hinge = static_cast<int>(k);
    }
    if (gaps.worst_axis < 0 || !(axis_gap <= gaps.axis_max)) {
      gaps.axis_max = axis_gap;
      gaps.worst_axis = static_cast<int>(k);
    }
    if (std::isnan(gap)) break;
  }
  gaps.rms = std::sqrt(sum / static_cast<double>(structure.hinges.size()));
  return gaps;
}

StateDistance aligned_distance(const Linkage& structure, const State& state, const State& reference) {
  const Eigen::Matrix3Xd from = positions(state);
  const Eigen::Matrix3Xd to = positions(reference);
  if (!from.allFinite() || !to.allFinite()) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  const Pose motion = motion_onto(state, reference);
  const Eigen::Matrix3Xd moved = (motion.R * from).colwise() + motion.p;
  const Eigen::VectorXd squared = (moved - to).colwise().squaredNorm();
  const double edge = structure.size.edge_mm;
  return {std::sqrt(squared.mean()) / edge, std::sqrt(squared.maxCoeff()) / edge};
}

Pose motion_onto(const State& state, const State& reference) {
  const Eigen::Matrix4d motion = rigid_fit(positions(state), positions(reference));
  return {motion.topLeftCorner<3, 3>(), motion.topRightCorner<3, 1>()};
}

State moved(State state, const Pose& motion) {
  for (Pose& pose : state) pose = {motion.R * pose.R, motion.R * pose.p + motion.p};
  return state;
}

State aligned(const State& state, const State& reference) {
  return moved(state, motion_onto(state, reference));
}

}  // namespace kinetix::model
