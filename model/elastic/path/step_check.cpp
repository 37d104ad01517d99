#include "model/elastic/path/step_check.hpp"

#include <algorithm>
#include <cmath>

#include "model/closure/closure_drive.hpp"

namespace kinetix::model {
namespace {

constexpr double bent_load = 0.01;      // fraction of the work of a step: its loads are not exactly linear
constexpr double bent_stiffness = 0.1;  // fraction of the change of load: stiffness is not exactly linear
/// Rad of theta: over a shorter step, derivatives do not match those at its ends.
constexpr double least_step = 1e-4;
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
  const double way =
      (after.drive - before.drive) * system_.elastic.drive().travel(system_.elastic.structure());
  const double bend = std::isfinite(after.stiffness) ? after.stiffness * (after.drive - before.drive) / 2 : 0;
  // Energy of the other branch at the start of the step.
  const double energy = after.energy - way * (after.load - bend);
  const double work = std::abs(way) * std::max(std::abs(before.load), std::abs(after.load));
  return before.energy - energy > bent_load * work + difference_noise * (system_.unit + before.energy);
}

bool StepCheck::keeps_load(const EquilibriumStep& before, const EquilibriumStep& after) {
  const bool known = std::isfinite(before.stiffness) && std::isfinite(after.stiffness);
  if (!known || !(std::abs(after.theta - before.theta) >= least_step)) return true;
  const double way = after.drive - before.drive, change = after.load - before.load;
  const auto [least, most] = std::minmax({before.stiffness * way, after.stiffness * way});
  const double slack = (most - least) / 2 + bent_stiffness * std::max(std::abs(least), std::abs(most)) +
                       load_noise * std::max(std::abs(before.load), std::abs(after.load));
  return change >= least - slack && change <= most + slack;
}

}  // namespace kinetix::model
