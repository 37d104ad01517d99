#include "model/elastic/predictor.hpp"

#include <cmath>
#include <utility>

namespace kinetix::model {
namespace {

using Eigen::VectorXd;

constexpr double longest = 0.3;

}  // namespace

State Predictor::predict(const State& state, double from, double to, const TangentStiffness& tangent) {
  order_ = 1;
  if (rate_.size() == 0) rate_ = rate(state, from, to, tangent);
  const double step = to - from;
  State first = ahead(state, to, step * rate_);
  if (last_rate_.size() == 0) return first;
  const VectorXd bend = (rate_ - last_rate_) / (from - last_theta_);
  State second = ahead(state, to, step * rate_ + step * step / 2 * bend);
  if (!(system_.energy(second, to) < system_.energy(first, to))) return first;
  order_ = 2;
  return second;
}

void Predictor::move_on(double from) {
  last_rate_ = std::exchange(rate_, VectorXd());
  last_theta_ = from;
}

void Predictor::restart() {
  rate_.resize(0);
  last_rate_.resize(0);
}

// Plates stand still to first order where they start.
VectorXd Predictor::rate(const State& state, double from, double to, const TangentStiffness& tangent) const {
  const VectorXd placed = system_.place_rate(from != 0 ? from : to / 2);
  const VectorXd pull = tangent.multiply_all(placed) + turn_pull(state, from);
  return -system_.dofs().extend(tangent.solve(system_.dofs().restrict(pull)));
}

VectorXd Predictor::turn_pull(const State& state, double from) const {
  VectorXd pull = VectorXd::Zero(system_.dofs().coordinates());
  if (system_.driven_hinge() < 0) return pull;
  const RestHinge& hinge = system_.hinges()[system_.driven_hinge()];
  const Vector12 by_theta =
      -ElasticSystem::grip * system_.drive_rate(from) * system_.driven_turn(state).gradient;
  pull.segment<6>(6 * hinge.lower) = by_theta.head<6>();
  pull.segment<6>(6 * hinge.upper) = by_theta.tail<6>();
  return pull;
}

State Predictor::ahead(const State& state, double to, VectorXd step) const {
  const double length = system_.length(state, step);
  if (!(length <= longest)) step *= longest / length;
  State out = step.allFinite() ? system_.retract(state, step) : state;
  system_.place(to, out);
  return out;
}

}  // namespace kinetix::model
