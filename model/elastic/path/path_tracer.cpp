#include "model/elastic/path/path_tracer.hpp"

#include <cmath>
#include <utility>

namespace kinetix::model {
namespace {

// Rad of theta, accuracy of event locations. A power of 2: its multiples are exact, so that the location of
// an event does not depend on the step that detected it.
constexpr double event_width = 0x1p-23;

}  // namespace

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
      stop_(options.stop),
      at_(record_.last()),
      options_(options) {}

EquilibriumPath PathTracer::run() {
  const double goal = system_.elastic.drive().theta();
  while (head_.theta() != goal) {
    if (stop_.stop_requested()) return record_.finished(EquilibriumPath::Stop::interrupted, refusal_);
    const Outcome outcome = advance(length_.next(head_.theta()));
    if (outcome == Outcome::ended) return record_.finished(refusal_.stop(record_.last()), refusal_);
    if (outcome == Outcome::taken && record_.is_overstretched())
      return record_.finished(EquilibriumPath::Stop::overstretched, refusal_);
  }
  return record_.finished(EquilibriumPath::Stop::reached, refusal_);
}

PathTracer::Outcome PathTracer::advance(const NextStep& next) {
  double multiplier = system_.elastic.multiplier();
  Attempt first = attempt(next);
  if (next.is_short && !is_plain(first)) {
    go_back(multiplier);
    if (settle_head()) {
      multiplier = system_.elastic.multiplier();
      first = attempt(next);
    }
  }
  if (is_plain(first)) {
    take(std::move(first));
    return Outcome::taken;
  }
  go_back(multiplier);
  // A search that does not converge is not an event as long as a shorter step can be tried.
  const bool may_be_event = first.trial.newton.converged || next.is_shortest;
  if (next.is_short && may_be_event) return take_event(std::move(first));
  if (next.to_goal) {
    // The attempt of a longer path at this point.
    Attempt beyond = attempt(length_.next_beyond(head_.theta()));
    go_back(multiplier);
    if (!is_plain(beyond)) first = std::move(beyond);
  }
  refuse(first);
  return Outcome::refused;
}

bool PathTracer::settle_head() {
  if (is_settled_ || head_.is_flat()) return false;
  is_settled_ = true;
  const double multiplier = system_.elastic.multiplier();
  NextStep here;
  here.theta = head_.theta();
  here.locates = here.is_short = true;
  Trial settled = solver_.find(here, head_, head_.state());
  record_.count(settled.iterations);
  const NewtonResult& newton = settled.newton;
  if (!newton.converged || !newton.stable || newton.met_negative) {
    go_back(multiplier);
    return false;
  }
  at_ = system_.measured(settled.state, settled.theta, true);
  head_.move_to(std::move(settled), false);
  return true;
}

PathTracer::Attempt PathTracer::attempt(const NextStep& next) {
  Attempt out;
  out.next = next;
  const State prediction = next.leaves ? head_.carried(next.theta) : head_.predicted(next.theta);
  out.order = head_.prediction_order();
  out.trial = solver_.find(next, head_, prediction);
  record_.count(out.trial.iterations);
  out.faults = check_.faults(head_.state(), prediction, out.trial);
  out.permitted = check_.permitted(next, at_, out.trial, out.faults);
  return out;
}

bool PathTracer::is_plain(const Attempt& attempt) const {
  if (!attempt.permitted) return false;
  // Any first step from flat to a side is accepted.
  if (head_.is_flat() && system_.has_branch_at_flat()) return true;
  const NewtonResult& newton = attempt.trial.newton;
  const bool turned_unstable =
      attempt.trial.descent || newton.met_negative || (attempt.next.locates && !newton.stable);
  return !turned_unstable && !attempt.permitted->snapped && !attempt.permitted->touches &&
         !attempt.permitted->bends && !record_.would_happen(at_, attempt.permitted->step);
}

PathTracer::Outcome PathTracer::take_event(Attempt event) {
  if (head_.is_flat() && system_.has_branch_at_flat()) return land(false);
  event = locate(std::move(event));
  if (at_.theta != record_.last().theta) record_.add(at_, {{}, false, head_.on_closed_form()});
  const double multiplier = system_.elastic.multiplier();
  Attempt behind = attempt(event.next);
  const bool stays = behind.permitted && !behind.permitted->snapped && behind.trial.newton.stable &&
                     !behind.trial.newton.met_negative && !behind.trial.descent;
  if (stays) {
    take(std::move(behind));
    return Outcome::taken;
  }
  go_back(multiplier);
  return land(true);
}

PathTracer::Attempt PathTracer::locate(Attempt event) {
  for (;;) {
    const double from = head_.theta(), to = event.next.theta;
    const double middle = event_width * std::round((from + to) / 2 / event_width);
    if (!((middle - from) * (to - middle) > 0)) return event;
    const double multiplier = system_.elastic.multiplier();
    NextStep next;
    next.theta = middle;
    next.length = std::abs(middle - from);
    next.locates = next.is_short = true;
    Attempt tried = attempt(next);
    if (is_plain(tried)) {
      at_ = tried.permitted->step;
      head_.move_to(std::move(tried.trial), false);
      continue;
    }
    go_back(multiplier);
    event = std::move(tried);
  }
}

PathTracer::Outcome PathTracer::land(bool located) {
  for (double length = options_.longest_step_touching;; length /= 2) {
    const double multiplier = system_.elastic.multiplier();
    Attempt landed = attempt(length_.landing(head_.theta(), std::max(length, options_.least_step)));
    if (landed.permitted && (head_.is_flat() || look_back(landed, located, multiplier))) {
      take(std::move(landed), located);
      return Outcome::taken;
    }
    refuse(landed);
    go_back(multiplier);
    if (length <= options_.least_step) return Outcome::ended;
  }
}

bool PathTracer::look_back(Attempt& landed, bool located, double multiplier) {
  Trial& trial = landed.trial;
  PermittedStep& step = *landed.permitted;
  if (located && !trial.descent) step.snapped = check_.loses_energy(at_, step.step);
  const Retrace::Finding found = retrace_.back({trial.state, trial.theta, system_.elastic.multiplier()},
                                               {head_.state(), head_.theta(), multiplier});
  if (found != Retrace::Finding::unknown) step.snapped = found == Retrace::Finding::lossy;
  // Such a step left an equilibrium that turned unstable, without a stop there.
  if (located && !step.snapped && step.bends && !trial.descent) trial.descent = Branch::Descent::lowest_mode;
  landed.faults.mirrored = found == Retrace::Finding::mirrored;
  return !landed.faults.mirrored;
}

void PathTracer::take(Attempt taken, bool located) {
  const auto descent = taken.trial.descent;
  const PermittedStep permitted = *taken.permitted;
  const bool new_branch = descent || permitted.snapped;
  const double growth = new_branch ? 1 : length_.growth(taken.faults.jump, taken.order);
  head_.move_to(std::move(taken.trial), permitted.snapped);
  at_ = permitted.step;
  is_settled_ = false;
  record_.add(permitted.step, {descent, permitted.snapped, head_.on_closed_form(), located});
  length_.change(growth, permitted.step.contacts > 0);
}

void PathTracer::refuse(const Attempt& refused) {
  const bool far_off = refused.faults.jumped || refused.faults.tunnelled;
  length_.shorten(refused.next, length_.growth(far_off ? refused.faults.jump : NAN, refused.order));
  refusal_ = {refused.faults, refused.trial.newton, system_.elastic.touching_words(refused.trial.state)};
}

void PathTracer::go_back(double multiplier) {
  system_.elastic.set_multiplier(multiplier);
  head_.restore_tangent();
}

}  // namespace kinetix::model
