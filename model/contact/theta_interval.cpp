#include "model/contact/theta_interval.hpp"

#include <cmath>

namespace kinetix::model {

using Eigen::Vector3d;

ThetaInterval::ThetaInterval(const LinkagePlates& plates, const ExactMotion& exact, double sign, double low,
                             double high)
    : plates_(plates),
      half_width_(std::nextafter((high - low) / 2, high)),
      theta_(sign * (low + high) / 2),
      state_(exact.at(theta_)) {
  for (const TurnLaw& law : plates.laws) {
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

std::vector<double> ThetaInterval::ways() const {
  std::vector<SweptMotion> motions(state_.size(), SweptMotion(half_width_));
  std::vector<double> out(state_.size());
  const int root = plates_.middle;
  motions[root].turn_about(state_[root].p, state_[root].R * plates_.structure.bodies[root].first_turn());
  out[root] = motions[root].way(state_[root].p, plates_.reach[root]);
  for (const HingeChains::Link& link : plates_.links) {
    SweptMotion& motion = motions[link.body] = motions[link.parent];
    pass(link.step, {}, motion);
    out[link.body] = motion.way(state_[link.body].p, plates_.reach[link.body]);
  }
  return out;
}

/// A hinge, in the frame of a pose.
void ThetaInterval::pass(const ChainStep& step, const Pose& frame, SweptMotion& motion) const {
  const RestHinge& hinge = plates_.structure.hinges[step.hinge];
  const Pose& lower = state_[hinge.lower];
  const int law = plates_.law_of[step.hinge];
  const Vector3d point = lower.p + lower.R * hinge.lower_arm * plates_.edge();
  motion.pass(frame.R.transpose() * (point - frame.p), frame.R.transpose() * (lower.R * hinge.axis),
              step.sense * plates_.senses[step.hinge] * rates_[law], bounds_[law]);
}

}  // namespace kinetix::model
