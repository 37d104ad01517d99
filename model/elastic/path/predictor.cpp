#include "model/elastic/path/predictor.hpp"

#include <cmath>
#include <utility>

#include "model/elastic/path/path_direction.hpp"

namespace kinetix::model {
namespace {

using Eigen::VectorXd;

constexpr double least_bent = 1e-3;  // rad of theta: below, the difference of two tangents is rounding
constexpr double longest = 0.3;      // rad, cell edges, of a hinge: a tangent is not valid further ahead

}  // namespace

State Predictor::predict(const State& state, double from, double to, const TangentStiffness& tangent) {
  order_ = 1;
  if (rate_.size() == 0) rate_ = path_direction(system_, state, from, from != 0 ? from : to / 2, tangent);
  const double step = to - from;
  State first = ahead(state, to, step * rate_);
  if (last_rate_.size() == 0) return first;
  const VectorXd bend = (rate_ - last_rate_) / (from - last_theta_);
  State second = ahead(state, to, step * rate_ + step * step / 2 * bend);
  if (!(system_.energy(second, to) < system_.energy(first, to))) return first;
  order_ = 2;
  return second;
}

void Predictor::move_on(double from, double to) {
  VectorXd rate = std::exchange(rate_, VectorXd());
  if (std::abs(to - from) < least_bent) return;
  last_rate_ = std::move(rate);
  last_theta_ = from;
}

void Predictor::restart() {
  rate_.resize(0);
  last_rate_.resize(0);
}

State Predictor::ahead(const State& state, double to, VectorXd step) const {
  const double length = system_.length(state, step);
  if (!(length <= longest)) step *= longest / length;
  State out = step.allFinite() ? system_.retract(state, step) : state;
  system_.place(to, out);
  return out;
}

}  // namespace kinetix::model
