#include "model/elastic/path/equilibrium_path.hpp"

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/path/closed_form.hpp"
#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/near_equilibrium.hpp"
#include "model/elastic/path/path_record.hpp"
#include "model/elastic/path/step_solver.hpp"

namespace kinetix::model {
namespace {

/// Test of whether a step of a path was reversible: follows the path backwards in small steps.
class Retrace {
 public:
  enum class Finding {
    reversible,  ///< back in the previous state, or in one of the same energy
    lossy,       ///< in another state of other energy: a snap-through
    mirrored,    ///< in the previous state, folded to the other side
    unknown,     ///< no equilibrium was found on the way back
  };

  /// All parameters are kept by reference.
  Retrace(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options)
      : driven_(driven), elasticity_(elasticity), options_(options) {}

  /// State in equilibrium at a theta, rad, with the multiplier of its drive.
  struct Place {
    const State& state;
    double theta = 0;
    double multiplier = 0;
  };
  Finding back(const Place& after, const Place& before);

 private:
  /// Settles a nearby state at theta. @return whether it is stable
  bool settle(double theta, State& state);

  const DrivenLinkage& driven_;
  const Elasticity& elasticity_;
  const EquilibriumPathOptions& options_;
  std::optional<MeasuredSystem> system_;  ///< separate from that of the path, which stays unchanged
};

/// Tracer of an equilibrium path from flat. Each step is predicted, solved for and checked, and its success
/// sets the length of the next one. Bisection locates begin and end of contact, jumps, instabilities and the
/// end of the path. Except for the last step, which ends at the goal, steps and events do not depend on the
/// goal. See trace_equilibrium() for the parameters and the result.
class PathTracer {
 public:
  /// All parameters are kept by reference.
  PathTracer(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options,
             const std::function<void(const EquilibriumStep&, const State&)>& frame);

  /// Traces the path. Call it once.
  EquilibriumPath run();

 private:
  /// Attempted step.
  struct Attempt {
    NextStep next;
    Trial trial;
    StepFaults faults;
    std::optional<PermittedStep> permitted;
    int order = 1;  ///< of the prediction
  };
  enum class Outcome { taken, refused, ended };

  Outcome advance(const NextStep& next);
  Attempt attempt(const NextStep& next);
  /// Settles a roughly converged head to full accuracy, so that its error does not look like an event after
  /// it.
  /// @return whether the head has moved
  bool settle_head();
  /// Returns whether a step may be taken without an event on it that must be located.
  bool is_plain(const Attempt& attempt) const;
  /// Moves the head to just before the event on a short step, and takes the step after it.
  Outcome accept_event(Attempt event);
  /// Bisects for an event. @return the shortest attempt from the head with the event; the head moves to just
  /// before it
  Attempt locate(Attempt event);
  /// Tries short steps from a head that no plain step can leave.
  Outcome land(bool located);
  /// Traces back from behind a jump. It is a snap-through if this ends in another state of other energy.
  /// @param located as in Arrival
  /// @param multiplier of the head
  /// @return false if the jump leads to the side that is not requested
  bool retrace_jump(Attempt& landed, bool located, double multiplier);
  /// @param located as in Arrival
  void take(Attempt attempt, bool located = false);
  void refuse(const Attempt& attempt);
  /// Returns to the head after a refused attempt.
  void step_history(double multiplier);

  MeasuredSystem system_;
  const ClosedForm closed_form_;
  PathHead head_;
  StepSolver solver_;
  const StepCheck check_;
  StepLength length_;
  PathRecord record_;
  Retrace retrace_;
  std::stop_token stop_;
  Refusal refusal_;     ///< of the last refused step
  EquilibriumStep at_;  ///< of the head
  /// Whether the head is converged to full accuracy, not only to the tolerance of steps before the goal.
  bool is_settled_ = true;
  const EquilibriumPathOptions& options_;
};

constexpr double back_step = 1e-3;  // rad of theta
constexpr int min_steps = 10,
              max_steps = 64;       // backwards over a jump: bounds of the number of steps
constexpr double same_turn = 1e-3;  // rad of a hinge
/// Fraction of the energy before: tolerance between two settled states.
constexpr double same_energy = 1e-6;

Retrace::Finding Retrace::back(const Place& after, const Place& before) {
  if (!system_) system_.emplace(driven_.linkage, elasticity_, driven_.drive, options_);
  ElasticSystem& elastic = system_->elastic;
  const double distance = before.theta - after.theta;
  const int steps =
      std::clamp(static_cast<int>(std::ceil(std::abs(distance) / back_step)), min_steps, max_steps);
  State state = after.state;
  elastic.set_multiplier(after.multiplier);
  for (int k = 0; k <= steps; ++k)
    if (!settle(after.theta + distance * k / steps, state)) return Finding::unknown;
  State first = before.state;
  elastic.set_multiplier(before.multiplier);
  if (!settle(before.theta, first)) return Finding::unknown;
  const Linkage& structure = elastic.structure();
  const double apart = turn_distance(structure, state, first);
  if (apart <= same_turn) return Finding::reversible;
  const double energy = elastic.stored_energy(first, before.theta);
  if (std::abs(energy - elastic.stored_energy(state, before.theta)) > same_energy * energy)
    return Finding::lossy;
  const bool is_mirrored =
      apart > ClosedForm::far && mean_theta(structure, state) * mean_theta(structure, first) < 0;
  return is_mirrored ? Finding::mirrored : Finding::reversible;
}

bool Retrace::settle(double theta, State& state) {
  system_->elastic.place(theta, state);
  const NewtonResult found = minimise(system_->elastic, theta, options_.newton, state, system_->tangent);
  return found.converged && found.stable;
}

// Rad of theta, accuracy of event locations. A power of 2: its multiples are exact, so that the location of
// an event does not depend on the step that detected it.
constexpr double event_width = 0x1p-23;

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
    step_history(multiplier);
    if (settle_head()) {
      multiplier = system_.elastic.multiplier();
      first = attempt(next);
    }
  }
  if (is_plain(first)) {
    take(std::move(first));
    return Outcome::taken;
  }
  step_history(multiplier);
  // A search that does not converge is not an event as long as a shorter step can be tried.
  const bool may_be_event = first.trial.newton.converged || next.is_shortest;
  if (next.is_short && may_be_event) return accept_event(std::move(first));
  if (next.to_goal) {
    // The attempt of a longer path at this point.
    Attempt beyond = attempt(length_.next_beyond(head_.theta()));
    step_history(multiplier);
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
  if (!newton.converged || !newton.stable || newton.was_indefinite) {
    step_history(multiplier);
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
      attempt.trial.descent || newton.was_indefinite || (attempt.next.locates && !newton.stable);
  return !turned_unstable && !attempt.permitted->snapped && !attempt.permitted->touches &&
         !attempt.permitted->bends && !record_.would_cause_event(at_, attempt.permitted->step);
}

PathTracer::Outcome PathTracer::accept_event(Attempt event) {
  if (head_.is_flat() && system_.has_branch_at_flat()) return land(false);
  event = locate(std::move(event));
  if (at_.theta != record_.last().theta) record_.add(at_, {{}, false, head_.on_closed_form()});
  const double multiplier = system_.elastic.multiplier();
  Attempt behind = attempt(event.next);
  const bool stays = behind.permitted && !behind.permitted->snapped && behind.trial.newton.stable &&
                     !behind.trial.newton.was_indefinite && !behind.trial.descent;
  if (stays) {
    take(std::move(behind));
    return Outcome::taken;
  }
  step_history(multiplier);
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
    step_history(multiplier);
    event = std::move(tried);
  }
}

PathTracer::Outcome PathTracer::land(bool located) {
  for (double length = options_.longest_step_touching;; length /= 2) {
    const double multiplier = system_.elastic.multiplier();
    Attempt landed = attempt(length_.landing(head_.theta(), std::max(length, options_.min_step)));
    if (landed.permitted && (head_.is_flat() || retrace_jump(landed, located, multiplier))) {
      take(std::move(landed), located);
      return Outcome::taken;
    }
    refuse(landed);
    step_history(multiplier);
    if (length <= options_.min_step) return Outcome::ended;
  }
}

bool PathTracer::retrace_jump(Attempt& landed, bool located, double multiplier) {
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
  refusal_ = {refused.faults, refused.trial.newton, system_.elastic.describe_touching(refused.trial.state)};
}

void PathTracer::step_history(double multiplier) {
  system_.elastic.set_multiplier(multiplier);
  head_.restore_tangent();
}

}  // namespace

void EquilibriumPathOptions::validate() const {
  require("side", side, side == 1 || side == -1, "1 or -1");
  require("first_step", first_step, first_step > 0 && first_step <= 0.5, "in (0, 0.5] rad");
  require("longest_step", longest_step, longest_step > 0 && longest_step <= 0.5, "in (0, 0.5] rad");
  require("longest_step_touching", longest_step_touching,
          longest_step_touching > 0 && longest_step_touching <= 0.5, "in (0, 0.5] rad");
  require("least_step", min_step,
          min_step > 0 && min_step <= std::min({first_step, longest_step, longest_step_touching}),
          "above 0 and at most first_step, longest_step and longest_step_touching");
  require("longest_jump", longest_jump, longest_jump > 0, "positive");
  require("gap_limit", gap_limit, gap_limit > 0, "positive");
}

double largest_load(const EquilibriumPath& path) {
  double largest = 0;
  for (const EquilibriumStep& step : path.steps)
    if (!(std::abs(step.load) <= largest)) largest = std::abs(step.load);
  return largest;
}

EquilibriumPath trace_equilibrium(const DrivenLinkage& driven, const Elasticity& elasticity,
                                  const EquilibriumPathOptions& options,
                                  const std::function<void(const EquilibriumStep&, const State&)>& frame) {
  options.validate();
  elasticity.validate();
  if (driven.drive.press) return trace_pressed(driven, elasticity, options, frame);
  return PathTracer(driven, elasticity, options, frame).run();
}

}  // namespace kinetix::model
