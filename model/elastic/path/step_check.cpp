#include "model/elastic/path/step_check.hpp"

#include <algorithm>

#include "model/closure/closure_drive.hpp"

namespace kinetix::model {
namespace {

constexpr double bent_load = 0.01;          // of the work of a step: loads between its ends are not on a line
constexpr double difference_noise = 1e-13;  // of the energy and of k_point edge^2: rounding of a difference

bool meets_walls(const EquilibriumStep& before, const EquilibriumStep& after) {
  return before.contacts == 0 && after.contacts > 0;
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
  const bool lost = !trial.descent && !keeps_energy(before, step);
  if (!next.is_short && (lost || meets_walls(before, step))) return {};
  return PermittedStep{step, faults.jumped || lost};
}

bool StepCheck::keeps_energy(const EquilibriumStep& before, const EquilibriumStep& after) const {
  const double path = (after.drive - before.drive) * system_.elastic.travel();
  const auto [least, most] = std::minmax({before.load * path, after.load * path});
  const double slack = (most - least) / 2 + bent_load * std::max(std::abs(least), std::abs(most)) +
                       difference_noise * (system_.unit + after.energy);
  const double change = after.energy - before.energy;
  return change >= least - slack && change <= most + slack;
}

}  // namespace kinetix::model
