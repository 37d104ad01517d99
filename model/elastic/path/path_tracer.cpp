#include "model/elastic/path/path_tracer.hpp"

#include <cmath>
#include <utility>

namespace kinetix::model {

PathTracer::PathTracer(const DrivenLinkage& driven, const Elasticity& elasticity,
                       const EquilibriumPathOptions& options,
                       const std::function<void(const EquilibriumStep&, const State&)>& frame)
    : system_(driven.linkage, elasticity, driven.drive, options),
      closed_form_(system_.elastic, driven.exact),
      head_(system_, closed_form_),
      solver_(system_, closed_form_, options),
      check_(system_, options.longest_jump),
      length_(options, driven.drive.theta()),
      record_(system_, closed_form_, head_, options, frame),
      retrace_(driven, elasticity, options),
      stop_(options.stop) {}

EquilibriumPath PathTracer::run() {
  const double goal = system_.elastic.drive().theta();
  while (head_.theta() != goal) {
    if (stop_.stop_requested()) return record_.finished(EquilibriumPath::Stop::interrupted, refusal_);
    const NextStep next = length_.next(head_.theta());
    const bool taken = advance(next);
    if (!taken && next.is_shortest) return record_.finished(refusal_.stop(record_.last()), refusal_);
    if (taken && record_.is_overstretched())
      return record_.finished(EquilibriumPath::Stop::overstretched, refusal_);
  }
  return record_.finished(EquilibriumPath::Stop::reached, refusal_);
}

bool PathTracer::advance(const NextStep& next) {
  const double multiplier = system_.elastic.multiplier();
  const State prediction = head_.predicted(next.theta);
  Trial trial = solver_.find(next, head_, prediction);
  record_.count(trial.iterations);
  StepFaults faults = check_.faults(head_.state(), prediction, trial);
  auto permitted = check_.permitted(next, record_.last(), trial, faults);
  if (permitted && look_back(next, trial, multiplier, *permitted, faults)) {
    take(std::move(trial), *permitted, faults.jump);
    return true;
  }
  refuse(next, trial, faults);
  system_.elastic.set_multiplier(multiplier);
  head_.restore_tangent();
  return false;
}

bool PathTracer::look_back(const NextStep& next, const Trial& trial, double multiplier,
                           PermittedStep& permitted, StepFaults& faults) {
  const bool left_flat = head_.theta() == 0 && system_.leaves_flat_to_a_side();
  if (left_flat || !(permitted.snapped || trial.descent || trial.newton.met_negative)) return true;
  const Retrace::Finding found = retrace_.back({trial.state, trial.theta, system_.elastic.multiplier()},
                                               {head_.state(), head_.theta(), multiplier});
  faults.mirrored = found == Retrace::Finding::mirrored;
  if (found != Retrace::Finding::unknown) permitted.snapped = found == Retrace::Finding::lossy;
  return !faults.mirrored && (!permitted.snapped || next.is_short);
}

void PathTracer::take(Trial trial, const PermittedStep& permitted, double jump) {
  const auto descent = trial.descent;
  const bool new_branch = descent || permitted.snapped;
  const double growth = new_branch ? 1 : length_.growth(jump, head_.prediction_order());
  head_.move_to(std::move(trial), permitted.snapped);
  record_.add(permitted.step, {descent, permitted.snapped, head_.on_closed_form()});
  length_.change(growth, permitted.step.contacts > 0);
}

void PathTracer::refuse(const NextStep& next, const Trial& trial, const StepFaults& faults) {
  const bool far_off = faults.jumped || faults.tunnelled;
  length_.shorten(next, length_.growth(far_off ? faults.jump : NAN, head_.prediction_order()));
  refusal_ = {faults, trial.newton, system_.elastic.touching_words(trial.state)};
}

}  // namespace kinetix::model
