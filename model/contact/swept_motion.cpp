#include "model/contact/swept_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace kinetix::model {

HingeChain reversed(HingeChain chain) {
  std::reverse(chain.begin(), chain.end());
  for (ChainStep& step : chain) step.sense = -step.sense;
  return chain;
}

HingeChains::HingeChains(const Linkage& linkage)
    : neighbours_(linkage.bodies.size()), link_of_(linkage.bodies.size()), round_of_(linkage.bodies.size()) {
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h) {
    const auto& [lower, upper] = std::pair(linkage.hinges[h].lower, linkage.hinges[h].upper);
    neighbours_[lower].push_back({upper, {h, 1}});
    neighbours_[upper].push_back({lower, {h, -1}});
  }
}

void HingeChains::start(int from) {
  ++round_;
  found_.clear();
  round_of_[from] = round_;
  link_of_[from] = -1;
}

const std::vector<HingeChain>& HingeChains::find(int from, const std::vector<int>& to) {
  start(from);
  std::size_t known = 0;
  const auto is_done = [&] {
    while (known < to.size() && is_met(to[known])) ++known;
    return known == to.size();
  };
  int body = from;
  for (std::size_t next = 0; !is_done(); body = found_[next++].body) {
    for (const Neighbour& neighbour : neighbours_[body]) {
      if (is_met(neighbour.to)) continue;
      round_of_[neighbour.to] = round_;
      link_of_[neighbour.to] = static_cast<int>(found_.size());
      found_.push_back({neighbour.to, body, neighbour.step});
    }
    if (next >= found_.size()) break;
  }
  chains_.clear();
  for (const int b : to) chains_.push_back(is_met(b) ? chain_to(b, from) : HingeChain{});
  return chains_;
}

HingeChain HingeChains::chain_to(int body, int from) const {
  HingeChain chain;
  while (body != from) {
    const Link& link = found_[link_of_[body]];
    chain.push_back(link.step);
    body = link.parent;
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

std::vector<HingeChains::Link> HingeChains::tree(int root) {
  std::vector<int> all(neighbours_.size());
  for (std::size_t b = 0; b < all.size(); ++b) all[b] = static_cast<int>(b);
  find(root, all);
  return found_;
}

namespace {

int middle_body(const Linkage& structure) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const LinkageBody& body : structure.bodies) middle += body.position;
  middle /= static_cast<double>(structure.bodies.size());
  const auto nearer = [&](const LinkageBody& a, const LinkageBody& b) {
    return (a.position - middle).squaredNorm() < (b.position - middle).squaredNorm();
  };
  const auto& bodies = structure.bodies;
  return static_cast<int>(std::min_element(bodies.begin(), bodies.end(), nearer) - bodies.begin());
}

}  // namespace

LinkageMotion::LinkageMotion(const Linkage& structure, const std::vector<TurnLaw>& turns)
    : structure(structure), chains(structure), middle(middle_body(structure)), links(chains.tree(middle)) {
  std::map<std::pair<double, double>, int> known;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const auto [at, is_new] = known.try_emplace({turns[h].p, turns[h].q}, static_cast<int>(laws.size()));
    if (is_new) laws.push_back(turns[h]);
    law_of.push_back(at->second);
    senses.push_back(hinge_sense(structure, h));
    const RestHinge& hinge = structure.hinges[h];
    longest_arm = std::max({longest_arm, hinge.lower_arm.norm(), hinge.upper_arm.norm()});
  }
}

int LinkageMotion::unconnected_body() const {
  std::vector<bool> is_joined(structure.bodies.size());
  is_joined[middle] = true;
  for (const HingeChains::Link& link : links) is_joined[link.body] = true;
  const auto loose = std::find(is_joined.begin(), is_joined.end(), false);
  return loose == is_joined.end() ? -1 : static_cast<int>(loose - is_joined.begin());
}

double LinkageMotion::margin_mm(std::size_t hinges, double gap, double off) const {
  const double steps = static_cast<double>(hinges) + 1;
  return edge() * steps * (gap + off * 2 * steps * longest_arm);
}

namespace {

constexpr double still = 1e-12;  // rad per rad: below it a screw's axis is undefined

}  // namespace

void SweptMotion::turn_about(const Eigen::Vector3d& point, const Eigen::Vector3d& spin) {
  omega_ = spin;
  v_ = point.cross(spin);
  max_omega_ = spin.norm();
  anchor_ = point;
  turns_ = 1;
  axis_ = spin.normalized();
}

void SweptMotion::screw(const Eigen::Vector3d& omega, const Eigen::Vector3d& v) {
  omega_ = omega;
  v_ = v;
  max_omega_ = omega.norm();
  turns_ = 1;
  if (!(max_omega_ > still)) return;
  anchor_ = omega.cross(v) / omega.squaredNorm();
  axis_ = omega / max_omega_;
}

void SweptMotion::pass(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, double rate,
                       const RateBounds& bounds) {
  anchor_change_ = change(point, 0);
  anchor_ = point;
  const double room = 1 - h_ * max_omega_;
  const double across =
      room > 0 ? std::min(max_omega_, (omega_.cross(axis).norm() + h_ * omega_change_) / room) : max_omega_;
  omega_change_ += bounds.change + bounds.rate * across;
  omega_ += rate * axis;
  v_ += rate * point.cross(axis);
  max_omega_ = omega_.norm() + h_ * omega_change_;
  ++turns_;
  axis_ = axis;
}

double SweptMotion::change(const Eigen::Vector3d& r, double reach) const {
  return anchor_change_ + (omega_change_ + max_omega_ * max_omega_) * ((r - anchor_).norm() + reach);
}

double SweptMotion::change_along(const Eigen::Vector3d& n, const Eigen::Vector3d& r, double reach) const {
  return change(r, reach) * (turns_ == 1 ? n.cross(axis_).norm() : 1);
}

double SweptMotion::travel(const Eigen::Vector3d& r, double reach) const {
  return h_ * (speed(r).norm() + omega_.norm() * reach + h_ / 2 * change(r, reach));
}

namespace {

using Eigen::Vector3d;

/// Returns a lower bound of n . p over the points of a part, at tau, mm.
double lowest(const SweptHull& part, const Vector3d& n, double tau) {
  double least = std::numeric_limits<double>::infinity();
  for (const SweptPoints& p : part) {
    Vector3d d = n;
    double moved = 0;
    if (p.motion) {
      d += tau * n.cross(p.motion->omega());
      moved = tau * n.dot(p.motion->speed(Vector3d::Zero())) -
              tau * tau / 2 * p.motion->change_along(n, p.center, p.radius);
    }
    const Vector3d seen = p.pose.R.transpose() * d;
    const double low = (seen.transpose() * *p.points).minCoeff();
    least = std::min(least, low + d.dot(p.pose.p) + moved);
  }
  return least;
}

}  // namespace

double min_gap(const SweptHull& a, const SweptHull& b, const Vector3d& n, double half_width) {
  const auto gap = [&](double tau) { return lowest(b, n, tau) + lowest(a, -n, tau); };
  return half_width > 0 ? std::min(gap(half_width), gap(-half_width)) : gap(0);
}

double travel(const SweptHull& part) {
  double most = 0;
  for (const SweptPoints& p : part)
    if (p.motion) most = std::max(most, p.motion->travel(p.center, p.radius));
  return most;
}

namespace {

// Rad, largest deviation of a hinge's turn from its law: files have angles to 1e-9
constexpr double lawful = 1e-6;

}  // namespace

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
