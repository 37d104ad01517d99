#include "model/elastic/path/path_head.hpp"

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

namespace {

// Largest turn of a hinge per theta of the drive. It is 2 for a basic sheet, and larger if the sheet bends or
// its tendon hardly shortens.
constexpr double max_turn = 8;

}  // namespace

PathHead::PathHead(MeasuredSystem& system, const ClosedForm& closed_form)
    : system_(system),
      closed_form_(closed_form),
      predictor_(system.elastic),
      state_(rest_state(system.elastic.structure())) {
  restore_tangent();
  const bool is_left_by_bifurcation = system.has_branch_at_flat() && !system.elastic.drive().grips_part;
  on_closed_form_ = !is_left_by_bifurcation && closed_form_.is_near(state_, theta_);
}

State PathHead::carried(double theta) const {
  State state = state_;
  system_.elastic.place(theta, state);
  return state;
}

State PathHead::predicted(double theta) {
  const ElasticSystem& elastic = system_.elastic;
  State state = has_tangent_ ? predictor_.predict(state_, theta_, theta, system_.tangent) : carried(theta);
  if (!on_closed_form_) return state;
  const std::optional<State> exact = closed_form_ahead(theta);
  return exact && elastic.energy(*exact, theta) < elastic.energy(state, theta) ? *exact : state;
}

std::optional<State> PathHead::closed_form_ahead(double theta) const {
  std::optional<State> exact = closed_form_.at(theta);
  if (!exact) return {};
  const double turn = turn_distance(system_.elastic.structure(), state_, *exact);
  if (!(turn <= max_turn * std::abs(theta - theta_) + ClosedForm::near)) return {};
  return exact;
}

void PathHead::move_to(Trial trial, bool snapped) {
  if (trial.descent || snapped)
    predictor_.restart();
  else
    predictor_.move_on(theta_, trial.theta);
  state_ = std::move(trial.state);
  theta_ = trial.theta;
  on_closed_form_ = (on_closed_form_ || trial.descent) && closed_form_.is_near(state_, theta_);
  has_tangent_ = trial.newton.stable;
  factor_ = system_.tangent.factors();
}

void PathHead::restore_tangent() {
  TangentStiffness& tangent = system_.tangent;
  system_.elastic.linearise(state_, theta_, tangent);
  if (tangent.factors() == factor_) return;
  has_tangent_ = tangent.factorise(0);
  factor_ = tangent.factors();
}

}  // namespace kinetix::model
