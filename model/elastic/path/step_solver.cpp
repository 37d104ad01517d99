#include "model/elastic/path/step_solver.hpp"

#include <algorithm>
#include <utility>

#include "model/elastic/path/drive_load.hpp"

namespace kinetix::model {
namespace {

using Descent = Branch::Descent;

constexpr double rough_step =
    2e-3;  // rad, cell edges: before the goal, a step this short leaves about its square
// Of the energy, by which that step may lower it: more is a slow valley. States before the goal are known to no more.
constexpr double level = 1e-5;
constexpr double strayed = 2;  // times longest_jump: so far from a prediction lies another branch
// Rad: longer steps must start convex and end soon; if not, halving is cheaper.
constexpr double careful_from = 0.01;
constexpr int careful_iterations = 15;  // of Newton's method, for such a step
// Of Newton's method, for the shortest step of springs: they hold no place, so that a snap goes as far as a release does.
constexpr int snap_iterations = 400;
constexpr int most_saddles = 5;  // left in a row at one theta: after more, there is no equilibrium to take

}  // namespace

Trial StepSolver::find(const NextStep& next, const PathHead& head, State prediction) {
  Trial trial;
  trial.theta = next.theta;
  trial.state = std::move(prediction);
  const bool left_flat = head.theta() == 0 && turns_softly(system_.elastic) && leave_head(next, head, trial);
  if (!left_flat) search(first_options(next), head.has_tangent(), trial);
  if (!next.locates) leave_saddles(next, trial);
  trial.mirrored = is_mirrored(trial);
  if (trial.mirrored && !next.locates && leave_head(next, head, trial)) trial.mirrored = is_mirrored(trial);
  return trial;
}

// Before the goal, the step after one of `rough_step` is quadratically small, and good enough to go on from.
NewtonOptions StepSolver::newton_options(const NextStep& next, bool may_stray) const {
  NewtonOptions options = options_.newton;
  if (!may_stray) options.most_moved = strayed * options_.longest_jump;
  if (next.is_shortest && system_.elastic.drive().heats_springs())
    options.max_iterations = std::max(options.max_iterations, snap_iterations);
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

bool StepSolver::is_mirrored(const Trial& trial) const {
  return trial.newton.converged && closed_form_.is_mirrored(trial.state, trial.theta);
}

bool StepSolver::leave_head(const NextStep& next, const PathHead& head, Trial& trial) {
  if (!system_.leaves_flat_to_a_side() || head.on_closed_form()) return false;
  const ElasticSystem& elastic = system_.elastic;
  State carried = head.state();
  elastic.place(next.theta, carried);
  elastic.linearise(carried, next.theta, system_.tangent);
  if (system_.tangent.factorise(0)) return false;
  Branch::Start start = branch_.leave(next.theta, carried, system_.tangent);
  if (start.descent == Descent::none || start.descent == Descent::unknown) return false;
  trial.descent = start.descent;
  trial.state = std::move(start.state);
  search(newton_options(next, true), false, trial);
  return true;
}

void StepSolver::leave_saddles(const NextStep& next, Trial& trial) {
  NewtonResult& newton = trial.newton;
  for (int left = 0; newton.converged && !newton.stable; ++left) {
    newton.converged = left < most_saddles;
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
