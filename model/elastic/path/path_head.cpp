#include "model/elastic/path/path_head.hpp"

#include <cmath>
#include <utility>

namespace kinetix::model {
namespace {

// Largest turn of a hinge per theta of the drive. It is 2 for a basic sheet, and larger if the sheet bends or
// its tendon hardly shortens.
constexpr double most_turn = 8;

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
  if (!(turn <= most_turn * std::abs(theta - theta_) + ClosedForm::near)) return {};
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
