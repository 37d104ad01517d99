#include "model/elastic/path/step_solver.hpp"

#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

constexpr double max_growth = 2;     // times the last step: one small error is not enough for more
constexpr double min_growth = 0.25;  // times the last step: a large error does not tell how much less
constexpr double aimed_jump = 0.4;   // ratio to longest_jump: near 1 more steps fail, near 0 more are needed
constexpr double min_jump = 1e-12;   // rad: below is rounding, and max_growth is reached long before
constexpr double rounding = 1e-9;    // fraction of a step or of the remaining path: less is rounding

}  // namespace

StepLength::StepLength(const EquilibriumPathOptions& options, double goal)
    : options_(options), goal_(goal), step_(options.first_step) {}

NextStep StepLength::next(double from) const {
  const double left = std::abs(goal_ - from);
  return to(step_ >= left * (1 - rounding) ? goal_ : from + std::copysign(step_, goal_), from);
}

NextStep StepLength::next_beyond(double from) const { return to(from + std::copysign(step_, goal_), from); }

NextStep StepLength::landing(double from, double length) const {
  const double left = std::abs(goal_ - from);
  NextStep step = to(length >= left ? goal_ : from + std::copysign(length, goal_), from);
  step.is_short = step.leaves = true;
  step.is_shortest = length <= options_.min_step;
  return step;
}

NextStep StepLength::to(double theta, double from) const {
  NextStep next;
  next.theta = theta;
  next.length = std::abs(theta - from);
  next.to_goal = theta == goal_;
  next.is_shortest = step_ <= options_.min_step || step_ < rounding * std::abs(goal_ - from);
  next.is_short = next.is_shortest || next.length <= options_.longest_step_touching * (1 + rounding);
  return next;
}

double StepLength::growth(double jump, int order) const {
  if (!std::isfinite(jump)) return min_growth;
  const double room = aimed_jump * options_.longest_jump / std::max(jump, min_jump);
  return std::clamp(std::pow(room, 1.0 / (order + 1)), min_growth, max_growth);
}

void StepLength::change(double growth, bool touching) {
  const double longest =
      touching ? std::min(options_.longest_step, options_.longest_step_touching) : options_.longest_step;
  step_ = std::clamp(step_ * growth, options_.min_step, longest);
}

void StepLength::shorten(const NextStep& refused, double growth) {
  step_ = std::max(refused.length * std::min(0.5, growth), options_.min_step);
}

namespace {

constexpr double bent_load = 0.01;      // fraction of the work of a step: its loads are not exactly linear
constexpr double bent_stiffness = 0.1;  // fraction of the change of load: stiffness is not exactly linear
/// Rad of theta: over a shorter step, derivatives do not match those at its ends.
constexpr double min_step = 1e-4;
/// Fraction of a load: rough states before the goal differ by this much without an event.
constexpr double load_noise = 1e-3;
constexpr double difference_noise = 1e-13;  // fraction of the energy and of k_point edge^2: rounding

bool changes_contact(const EquilibriumStep& before, const EquilibriumStep& after) {
  return (before.contacts == 0) != (after.contacts == 0);
}

}  // namespace

StepFaults StepCheck::faults(const State& before, const State& prediction, const Trial& trial) const {
  StepFaults faults;
  if (!trial.newton.converged) return faults;
  faults.jump = turn_distance(system_.elastic.structure(), prediction, trial.state);
  faults.jumped = !trial.descent && faults.jump > longest_jump_;
  faults.tunnelled = (!trial.descent && system_.elastic.passed_through(before, trial.state)) ||
                     system_.elastic.newly_cross(before, trial.state);
  faults.mirrored = trial.mirrored;
  return faults;
}

std::optional<PermittedStep> StepCheck::permitted(const NextStep& next, const EquilibriumStep& before,
                                                  const Trial& trial, const StepFaults& faults) const {
  if (!trial.newton.converged || faults.tunnelled || faults.mirrored) return {};
  if (faults.jumped && !next.is_short) return {};
  const EquilibriumStep step = system_.measured(trial.state, trial.theta, trial.newton.stable);
  const bool lost = !trial.descent && !keeps_energy(before, step), bends = !keeps_load(before, step);
  const bool touches = changes_contact(before, step);
  if (!next.is_short && (lost || touches || bends)) return {};
  return PermittedStep{step, faults.jumped || lost, touches, bends};
}

bool StepCheck::keeps_energy(const EquilibriumStep& before, const EquilibriumStep& after) const {
  const double path =
      (after.drive - before.drive) * system_.elastic.drive().travel(system_.elastic.structure());
  const auto [least, most] = std::minmax({before.load * path, after.load * path});
  const double slack = (most - least) / 2 + bent_load * std::max(std::abs(least), std::abs(most)) +
                       difference_noise * (system_.unit + after.energy);
  const double change = after.energy - before.energy;
  return change >= least - slack && change <= most + slack;
}

bool StepCheck::loses_energy(const EquilibriumStep& before, const EquilibriumStep& after) const {
  const double drive_change =
      (after.drive - before.drive) * system_.elastic.drive().travel(system_.elastic.structure());
  const double bend = std::isfinite(after.stiffness) ? after.stiffness * (after.drive - before.drive) / 2 : 0;
  // Energy of the other branch at the start of the step.
  const double energy = after.energy - drive_change * (after.load - bend);
  const double work = std::abs(drive_change) * std::max(std::abs(before.load), std::abs(after.load));
  return before.energy - energy > bent_load * work + difference_noise * (system_.unit + before.energy);
}

bool StepCheck::keeps_load(const EquilibriumStep& before, const EquilibriumStep& after) {
  const bool known = std::isfinite(before.stiffness) && std::isfinite(after.stiffness);
  if (!known || !(std::abs(after.theta - before.theta) >= min_step)) return true;
  const double drive_change = after.drive - before.drive, change = after.load - before.load;
  const auto [least, most] = std::minmax({before.stiffness * drive_change, after.stiffness * drive_change});
  const double slack = (most - least) / 2 + bent_stiffness * std::max(std::abs(least), std::abs(most)) +
                       load_noise * std::max(std::abs(before.load), std::abs(after.load));
  return change >= least - slack && change <= most + slack;
}

namespace {

using Descent = Branch::Descent;
using Eigen::VectorXd;

/// Rad, cell edges: before the goal, a step this short leaves about its square as error.
constexpr double rough_step = 2e-3;
// Fraction of the energy that this step may gain: more means a slow valley. States before the goal are
// accurate to this only.
constexpr double level = 1e-5;
constexpr double strayed = 2;  // times longest_jump: another branch is this far from a prediction
// Rad: longer steps must start convex and end soon; otherwise halving is cheaper.
constexpr double careful_from = 0.01;
constexpr int careful_iterations = 15;  // of Newton's method, for such a step
// Iterations of Newton's method for the shortest step. Springs do not fix a position, so a snap-through goes
// as far as a release. Underconstrained sheets have curved valleys.
constexpr int snap_iterations = 400;
// Share of the energy. Two branches after a bifurcation that differ by less are mirror images.
constexpr double same_depth = 1e-7;
constexpr double equally_far = 2;    // ratio of distances to two branches: up to it, a path is on neither
constexpr double same_state = 1e-3;  // rad of a hinge, cell edges
constexpr int max_saddles = 5;       // left in a row at one theta: with more, there is no equilibrium to take

/// Returns the twists, rad and cell edges, that move each body from one state to another.
VectorXd twists_between(const Linkage& structure, const State& from, const State& to) {
  VectorXd twists(6 * static_cast<Eigen::Index>(from.size()));
  for (std::size_t b = 0; b < from.size(); ++b) {
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(to[b].R * from[b].R.transpose()));
    twists.segment<6>(6 * static_cast<Eigen::Index>(b)) << turn.angle() * turn.axis(),
        (to[b].p - from[b].p) / structure.size.edge_mm;
  }
  return twists;
}

}  // namespace

Trial StepSolver::find(const NextStep& next, const PathHead& head, const State& prediction) {
  Trial trial;
  trial.theta = next.theta;
  trial.state = prediction;
  const bool left_flat = head.theta() == 0 && turns_softly(system_.elastic) && leave_head(next, head, trial);
  if (!left_flat) search(first_options(next), head.has_tangent(), trial);
  if (!trial.newton.converged) search_from_closed_form(next, head, trial);
  if (!next.locates) {
    choose_side(next, head, prediction, trial);
    leave_saddles(next, trial);
    if (trial.descent && !head.is_flat()) polish(trial);
  }
  trial.mirrored = is_mirrored(trial);
  if (trial.mirrored && !next.locates && leave_head(next, head, trial)) trial.mirrored = is_mirrored(trial);
  return trial;
}

// Before the goal, the error after a step of `rough_step` is quadratically small, which is sufficient to
// continue.
NewtonOptions StepSolver::newton_options(const NextStep& next, bool may_leave_branch) const {
  NewtonOptions options = options_.newton;
  if (!may_leave_branch) options.most_moved = strayed * options_.longest_jump;
  if (next.is_shortest) options.max_iterations = std::max(options.max_iterations, snap_iterations);
  if (next.to_goal || next.locates) return options;
  options.step_tolerance = std::max(options.step_tolerance, rough_step);
  options.energy_tolerance = level;
  options.drive_tolerance = std::max(options.drive_tolerance, rough_step * rough_step);
  return options;
}

NewtonOptions StepSolver::first_options(const NextStep& next) const {
  NewtonOptions options = newton_options(next, next.is_short && !next.locates);
  if (!next.locates && (next.is_shortest || next.length <= careful_from)) return options;
  options.starts_convex = true;
  options.max_iterations = std::min(options.max_iterations, careful_iterations);
  return options;
}

void StepSolver::search(const NewtonOptions& options, bool factorised, Trial& trial) {
  trial.newton = minimise(system_.elastic, trial.theta, options, trial.state, system_.tangent, factorised);
  trial.iterations += trial.newton.iterations;
}

void StepSolver::search_from_closed_form(const NextStep& next, const PathHead& head, Trial& trial) {
  std::optional<State> exact = head.on_closed_form() ? head.closed_form_ahead(next.theta) : std::nullopt;
  if (!exact) return;
  trial.state = std::move(*exact);
  search(first_options(next), false, trial);
}

bool StepSolver::is_mirrored(const Trial& trial) const {
  return trial.newton.converged && closed_form_.is_mirrored(trial.state, trial.theta);
}

bool StepSolver::leave_head(const NextStep& next, const PathHead& head, Trial& trial) {
  if (!system_.has_branch_at_flat() || head.on_closed_form()) return false;
  const ElasticSystem& elastic = system_.elastic;
  const State carried = head.carried(next.theta);
  elastic.linearise(carried, next.theta, system_.tangent);
  if (system_.tangent.factorise(0)) return false;
  Branch::Start start = branch_.leave(next.theta, carried, system_.tangent);
  if (start.descent == Descent::none || start.descent == Descent::unknown) return false;
  trial.descent = start.descent;
  trial.state = std::move(start.state);
  search(newton_options(next, true), false, trial);
  return true;
}

void StepSolver::choose_side(const NextStep& next, const PathHead& head, const State& prediction,
                             Trial& trial) {
  if (!trial.newton.converged || trial.descent || (head.is_flat() && system_.has_branch_at_flat())) return;
  const Linkage& structure = system_.elastic.structure();
  if (!next.leaves && !trial.newton.was_indefinite &&
      !(turn_distance(structure, prediction, trial.state) > options_.longest_jump))
    return;
  if (!polish(trial)) return;
  const State from = head.carried(trial.theta);
  const VectorXd off = twists_between(structure, from, trial.state);
  if (!(system_.elastic.length(from, off) > same_state)) return;
  const double multiplier = system_.elastic.multiplier();
  Trial twin = trial;
  State mirrored = system_.elastic.retract(from, -off);
  system_.elastic.place(trial.theta, mirrored);
  bool uses_twin = false;
  if (search_from(std::move(mirrored), twin) &&
      (next.leaves ? differ(trial, twin) : are_twins(trial, twin))) {
    const double to_trial = turn_distance(structure, head.state(), trial.state),
                 to_twin = turn_distance(structure, head.state(), twin.state);
    const bool begins_here = std::max(to_trial, to_twin) <= equally_far * std::min(to_trial, to_twin);
    if (begins_here) {
      trial.descent = Descent::lowest_mode;
      uses_twin = branch_.side_of(twists_between(structure, twin.state, trial.state)) < 0;
    } else {
      uses_twin = !next.leaves && to_twin < to_trial;
    }
  }
  if (uses_twin) {
    trial.state = std::move(twin.state);
    trial.newton = twin.newton;
    return;
  }
  system_.elastic.set_multiplier(multiplier);
  search_from(trial.state, trial);
}

bool StepSolver::polish(Trial& trial) {
  if (!trial.newton.converged) return false;
  const Trial rough = trial;
  const double multiplier = system_.elastic.multiplier();
  if (search_from(trial.state, trial) || trial.newton.converged) return trial.newton.stable;
  trial = rough;
  system_.elastic.set_multiplier(multiplier);
  system_.elastic.linearise(trial.state, trial.theta, system_.tangent);
  return trial.newton.stable && system_.tangent.factorise(0);
}

bool StepSolver::search_from(State start, Trial& trial) {
  trial.state = std::move(start);
  search(options_.newton, false, trial);
  return trial.newton.converged && trial.newton.stable;
}

bool StepSolver::differ(const Trial& one, const Trial& other) const {
  return turn_distance(system_.elastic.structure(), one.state, other.state) > same_state;
}

bool StepSolver::are_twins(const Trial& one, const Trial& other) const {
  const ElasticSystem& elastic = system_.elastic;
  if (!differ(one, other)) return false;
  const double energy = elastic.stored_energy(one.state, one.theta);
  return std::abs(energy - elastic.stored_energy(other.state, other.theta)) <= same_depth * energy;
}

void StepSolver::leave_saddles(const NextStep& next, Trial& trial) {
  NewtonResult& newton = trial.newton;
  for (int left = 0; newton.converged && !newton.stable; ++left) {
    newton.converged = left < max_saddles;
    if (!newton.converged) return;
    Branch::Start start = branch_.leave(trial.theta, trial.state, system_.tangent);
    if (start.descent == Descent::none) return;
    newton.converged = start.descent != Descent::unknown;
    if (!newton.converged) return;
    if (left == 0 || start.descent != Descent::lowest_mode) trial.descent = start.descent;
    const double saddle = system_.elastic.energy(trial.state, trial.theta);
    trial.state = std::move(start.state);
    search(newton_options(next, true), false, trial);
    const double energy = system_.elastic.energy(trial.state, trial.theta);
    newton.converged = newton.converged && energy <= saddle * (1 + level);
  }
}

}  // namespace kinetix::model
