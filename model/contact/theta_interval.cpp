#include "model/contact/theta_interval.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kinetix::model {
namespace {

// Rad, largest deviation of a hinge's turn from its law: files have angles to 1e-9
constexpr double lawful = 1e-6;

}  // namespace

using Eigen::Vector3d;

ThetaInterval::ThetaInterval(const LinkageMotion& linkage, const ExactMotion& exact, double sign, double low,
                             double high)
    : linkage_(linkage),
      half_width_(std::nextafter((high - low) / 2, high)),
      theta_(sign * (low + high) / 2),
      state_(exact.at(theta_)) {
  for (const TurnLaw& law : linkage.laws) {
    rates_.push_back(law.rate(theta_));
    bounds_.push_back(bounds_of(law, theta_ - half_width_, theta_ + half_width_));
  }
}

Pose ThetaInterval::relative(int from, int body) const {
  const Eigen::Matrix3d back = state_[from].R.transpose();
  return {back * state_[body].R, back * (state_[body].p - state_[from].p)};
}

SweptMotion ThetaInterval::motion(int from, const HingeChain& chain) const {
  SweptMotion motion(half_width_);
  for (const ChainStep& step : chain) pass(step, state_[from], motion);
  return motion;
}

std::vector<SweptMotion> ThetaInterval::motions() const {
  std::vector<SweptMotion> motions(state_.size(), SweptMotion(half_width_));
  const int root = linkage_.middle;
  motions[root].turn_about(state_[root].p, state_[root].R * linkage_.structure.bodies[root].first_turn());
  for (const HingeChains::Link& link : linkage_.links) {
    motions[link.body] = motions[link.parent];
    pass(link.step, {}, motions[link.body]);
  }
  return motions;
}

LawDeviation ThetaInterval::deviation() const {
  const HingeGaps gaps = hinge_gaps(linkage_.structure, state_);
  LawDeviation out{gaps.max, gaps.axis_max};
  for (std::size_t h = 0; h < linkage_.structure.hinges.size(); ++h) {
    const RestHinge& hinge = linkage_.structure.hinges[h];
    const Eigen::AngleAxisd turn(linkage_.senses[h] * linkage_.laws[linkage_.law_of[h]].turn(theta_),
                                 hinge.axis);
    const Eigen::Matrix3d upper = state_[hinge.lower].R * turn.toRotationMatrix();
    out.off = std::max(out.off, (upper - state_[hinge.upper].R).norm());
    if (!(out.off <= lawful) && out.hinge < 0) out.hinge = static_cast<int>(h);
  }
  return out;
}

/// Passes a hinge in the frame of a pose.
void ThetaInterval::pass(const ChainStep& step, const Pose& frame, SweptMotion& motion) const {
  const RestHinge& hinge = linkage_.structure.hinges[step.hinge];
  const Pose& lower = state_[hinge.lower];
  const int law = linkage_.law_of[step.hinge];
  const Vector3d point = lower.p + lower.R * hinge.lower_arm * linkage_.edge();
  motion.pass(frame.R.transpose() * (point - frame.p), frame.R.transpose() * (lower.R * hinge.axis),
              step.sense * linkage_.senses[step.hinge] * rates_[law], bounds_[law]);
}

}  // namespace kinetix::model
