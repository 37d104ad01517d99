#include "model/elastic/path/path_record.hpp"

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Kind = PathEvent::Kind;
using Descent = Branch::Descent;

// Change of the drive. Over a smaller change, the difference of two loads is the residual of Newton's method.
constexpr double min_change = 1e-6;
constexpr double steep = 30;  // times the steepest slope of the load before contact: jamming
// Fraction of the largest tension on the path. A smaller compression is the residual of Newton's method.
constexpr double no_push = 1e-6;

std::string words(Descent descent, bool on_closed_form) {
  switch (descent) {
    case Descent::closed_form:
      return on_closed_form ? "exact mode" : "exact mode, to less energy off the analytic motion";
    case Descent::off_closed_form:
      return "lowest mode, since the analytic motion is unstable too";
    default:
      return "lowest mode";
  }
}

}  // namespace

std::optional<double> JammingDetector::peek(const EquilibriumStep& before,
                                            const EquilibriumStep& after) const {
  if (locked_ || after.contacts == 0 || !(free_slope_ > 0)) return {};
  double slope = after.stiffness;
  if (std::isnan(slope)) {
    const double change = after.drive - before.drive;
    if (before.contacts == 0 || !(std::abs(change) >= min_change)) return {};
    slope = (after.load - before.load) / change;
  }
  if (!(slope > steep * free_slope_)) return {};
  return slope / free_slope_;
}

std::optional<double> JammingDetector::see(const EquilibriumStep& before, const EquilibriumStep& after) {
  const double change = after.drive - before.drive;
  if (after.contacts == 0 && std::abs(change) >= min_change)
    free_slope_ = std::max(free_slope_, std::abs((after.load - before.load) / change));
  const auto times = peek(before, after);
  locked_ = locked_ || times;
  return times;
}

bool SlackDetector::peek(const EquilibriumStep& step) const {
  return !slack_ && step.load < -no_push * std::max(largest_, std::abs(step.load));
}

bool SlackDetector::see(const EquilibriumStep& step) {
  largest_ = std::max(largest_, std::abs(step.load));
  const bool was_slack = std::exchange(slack_, step.load < -no_push * largest_);
  return slack_ && !was_slack;
}

void PathEvents::see(const EquilibriumStep& before, const EquilibriumStep& after, const State& state,
                     const Arrival& arrival) {
  // A jump happens where the path leaves its branch. The length of the step after it has no meaning.
  const EquilibriumStep& at = arrival.located && (arrival.snapped || arrival.descent) ? before : after;
  const auto happened = [&](Kind kind, std::string what) { add(kind, at, before.theta, std::move(what)); };
  if (arrival.descent) {
    if (arrival.on_closed_form) off_ = {};
    if (arrival.descent == Descent::off_closed_form) off_ = {at.theta, true};
    happened(
        arrival.snapped ? Kind::snap : Kind::bifurcation,
        "the equilibrium turned unstable: left along the " + words(*arrival.descent, arrival.on_closed_form));
  } else if (arrival.snapped)
    happened(Kind::snap, "jumped to another state at nearly the same drive");
  if (auto words = departure(after, state, arrival)) happened(Kind::departure, std::move(*words));
  if (before.contacts == 0 && after.contacts > 0) happened(Kind::contact, system_.describe_touching(state));
  if (before.contacts > 0 && after.contacts == 0)
    happened(Kind::release, system_.touching_kind() + " no longer touch");
  if (system_.drive().only_pulls() && slack_.see(after))
    happened(Kind::slack,
             "the tendon goes slack, because it cannot push, and the structure continues without it");
  if (arrival.snapped) return;
  if (const auto times = lock_.see(before, after))
    happened(Kind::lock, system_.touching_kind() + " carry the drive: the load rises " +
                             number_text(std::round(*times)) + " times as steeply as without contact");
}

std::optional<std::string> PathEvents::departure(const EquilibriumStep& after, const State& state,
                                                 const Arrival& arrival) {
  const auto turn = branching_.see(state, after.theta, arrival.on_closed_form);
  if (branching_.is_back() && !off_.unstable) off_ = {};
  if (!turn || off_.unstable) return {};
  off_ = {after.theta, false};
  if (arrival.descent || arrival.snapped) return {};
  return describe_branching(system_, closed_form_, state, after.theta, *turn);
}

void PathEvents::end_locked(const EquilibriumStep& last, const std::string& touching,
                            const std::string& why) {
  if (last.contacts == 0)
    add(Kind::contact, last, last.theta, touching.empty() ? system_.touching_kind() + " touch" : touching);
  if (!lock_.has_locked()) add(Kind::lock, last, last.theta, why);
}

void PathEvents::add(Kind kind, const EquilibriumStep& at, double since, std::string what) {
  events_.push_back({kind, at, since, std::move(what)});
}

std::string to_string(PathEvent::Kind kind) {
  switch (kind) {
    case Kind::bifurcation:
      return "bifurcation";
    case Kind::snap:
      return "snap";
    case Kind::limit_point:
      return "limit point";
    case Kind::contact:
      return "contact";
    case Kind::release:
      return "release";
    case Kind::slack:
      return "slack";
    case Kind::departure:
      return "departure";
    case Kind::lock:
      break;
  }
  return "lock";
}

namespace {

using Stop = EquilibriumPath::Stop;

std::string degrees(double theta) { return number_text(to_degrees(theta)) + " deg"; }

std::string place(const EquilibriumStep& last, const LinkageDrive& drive, const OffClosedForm& off) {
  const std::string at = " at a fold angle of " + degrees(last.theta) +
                         (drive.determines_fold() ? "" : " of the drive") + ", load " +
                         number_text(last.load) + " " + drive.load_unit();
  if (!std::isfinite(off.since)) return at;
  return at + "; off the analytic motion since " + degrees(off.since) +
         (off.unstable ? ", where that is unstable" : "");
}

std::string overstretched(const HingeGaps& gaps, const Linkage& linkage, double gap_limit) {
  return "the hinge on wall " + linkage.wall_name(gaps.worst_hinge) + " separated by " +
         number_text(gaps.max) + " cell edges; at most " + number_text(gap_limit) + " is allowed;";
}

std::string locked(const Refusal& refusal, const std::string& what) {
  return what + " in contact jam the structure: " +
         (refusal.faults.tunnelled ? "further on they would have to pass through each other;"
                                   : "no equilibrium found further on;");
}

std::string not_converged(const Refusal& refusal) {
  if (refusal.faults.mirrored) return "further on the sheet folds to the opposite side;";
  return "no equilibrium found further on (" + number_text(refusal.newton.iterations) +
         " iterations, force " + number_text(refusal.newton.force) + " left);";
}

}  // namespace

EquilibriumPath::Stop Refusal::stop(const EquilibriumStep& last) const {
  return last.contacts == 0 && touching.empty() && !faults.tunnelled ? Stop::not_converged : Stop::locked;
}

std::string stop_reason(const EquilibriumPath& path, const MeasuredSystem& system, double gap_limit,
                        const Refusal& refusal, const OffClosedForm& off) {
  const std::string at = place(path.steps.back(), system.elastic.drive(), off);
  switch (path.stop) {
    case Stop::reached:
      return "the drive reached its goal" + at;
    case Stop::overstretched:
      return overstretched(path.gaps, system.elastic.structure(), gap_limit) + at;
    case Stop::locked:
      return locked(refusal, system.elastic.touching_kind()) + at;
    case Stop::interrupted:
      return "it was stopped" + at;
    case Stop::not_converged:
      break;
  }
  return not_converged(refusal) + at;
}

std::string to_string(EquilibriumPath::Stop stop) {
  switch (stop) {
    case Stop::reached:
      return "reached";
    case Stop::overstretched:
      return "torn";
    case Stop::locked:
      return "locked";
    case Stop::interrupted:
      return "interrupted";
    case Stop::not_converged:
      break;
  }
  return "not converged";
}

PathRecord::PathRecord(const MeasuredSystem& system, const ClosedForm& closed_form, const PathHead& head,
                       const EquilibriumPathOptions& options,
                       const std::function<void(const EquilibriumStep&, const State&)>& frame)
    : system_(system),
      closed_form_(closed_form),
      head_(head),
      options_(options),
      frame_(frame),
      events_(system.elastic, closed_form, head.on_closed_form()) {
  path_.planar = system.planar;
  append(system.measured(head.state(), head.theta(), head.has_tangent()));
}

void PathRecord::add(const EquilibriumStep& step, const Arrival& arrival) {
  const EquilibriumStep before = last();
  append(step);
  events_.see(before, step, head_.state(), arrival);
}

void PathRecord::append(const EquilibriumStep& step) {
  path_.steps.push_back(step);
  if (frame_) frame_(step, head_.state());
}

EquilibriumPath PathRecord::finished(EquilibriumPath::Stop stop, const Refusal& refusal) {
  path_.stop = stop;
  path_.state = head_.state();
  path_.theta = head_.theta();
  path_.gaps = hinge_gaps(system_.elastic.structure(), path_.state);
  path_.why = stop_reason(path_, system_, options_.gap_limit, refusal, events_.off_closed_form());
  path_.off_closed_form_since = events_.off_closed_form().since;
  path_.off_closed_form =
      std::isfinite(path_.off_closed_form_since) || closed_form_.is_far(path_.state, path_.theta);
  if (stop == EquilibriumPath::Stop::locked) events_.end_locked(last(), refusal.touching, path_.why);
  path_.events = events_.events();
  path_.hinge_energies = system_.hinge_energies(path_.state);
  path_.multiplier = system_.elastic.multiplier();
  return std::move(path_);
}

}  // namespace kinetix::model
