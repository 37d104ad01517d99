#include "app/pipeline/pipeline.hpp"

#include <algorithm>
#include <future>
#include <iterator>
#include <utility>

#include "app/pipeline/design_drive.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/forecast_design.hpp"
#include "app/pipeline/judgement.hpp"
#include "app/pipeline/matter.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/pipeline/verify.hpp"
#include "app/run/design_hinges.hpp"
#include "app/run/drive_end.hpp"
#include "app/run/stopwatch.hpp"
#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

template <class T>
void append(std::vector<T> more, std::vector<T>& to) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

/// Of the equilibrium of elastic hinges; nothing where its drive did not come through.
std::optional<PhysicsTask> elastic_task(const Run& run) {
  const Equilibrium& equilibrium = *run.equilibrium;
  if (!equilibrium.reached()) return std::nullopt;
  const sim::PhysicsOptions options =
      elastic_physics(equilibrium.elasticity, run.design.physics, run.design.structure.size().edge_mm,
                      run.plan.planar, equilibrium.drive.k_spring);
  return PhysicsTask{equilibrium.path.state, equilibrium.drive, options};
}

/// Of a design: empty where there is none of the whole drive.
model::State reference_of(const Run& run) {
  const bool on_the_way = run.equilibrium && !run.equilibrium->reached();
  return run.states.empty() || on_the_way ? model::State{} : run.states.front().poses;
}

std::optional<PhysicsTask> physics_task(const Run& run) {
  if (!run.goal)
    return PhysicsTask{reference_of(run), drive_of(run.design), physics_of(run.design, run.plan.planar)};
  const PhysicsWish& wish = run.physics;
  if (wish.when == PhysicsWish::When::never) return std::nullopt;
  if (run.equilibrium) return elastic_task(run);
  if (wish.when == PhysicsWish::When::if_met && !run.met()) return std::nullopt;
  sim::PhysicsOptions options =
      rotary_physics(run.design.hinge, run.design.physics, run.design.structure.size().edge_mm);
  options.settle_seconds = std::max(options.settle_seconds, wish.least_settle_s);
  return PhysicsTask{run.own, wish.drive ? *wish.drive : drive_to(run.design.structure, run.theta), options};
}

/// On a thread of its own where there may be one and the system gives it.
std::future<void> work_beside(Judging& judging, int threads) {
  const auto policy =
      model::threads_of(threads) > 1 ? std::launch::async | std::launch::deferred : std::launch::deferred;
  return std::async(policy, [&judging] { judging.work(); });
}

void judge_by_physics(Run& run, const Scene* scene, const RunOptions& options) {
  if (!scene) return;
  if (is_settled(*run.verification))
    run.by_physics = scene->measure(run, StateOf::physics, run.verification->physics.state, options);
  if (run.by_physics && run.by_physics->shown) run.states.back().poses = *run.by_physics->shown;
  if (run.met())  // of a state that misses its goal, physics says so too
    run.verification->agrees &= run.physics_violations().empty();
}

std::optional<Verification> timed_physics(Run& run, const PhysicsTask& task, const RunOptions& options,
                                          bool usual_steps = false) {
  Stopwatch watch;
  std::optional<Verification> out = verify(run, task, options, usual_steps);
  run.timings.verify += watch.lap();
  return out;
}

/// Where coarser steps came near enough to the model's state, but not to the goal, which may be stricter.
void repeat_finer(Run& run, const Scene* scene, const PhysicsTask& task, const RunOptions& options) {
  const double spent = run.verification->physics.seconds;
  remove_coarse(run);
  std::optional<Verification> finer = timed_physics(run, task, options, true);
  if (!finer) return;
  finer->physics.seconds += spent;
  add(std::move(*finer), task, options, run);
  judge_by_physics(run, scene, options);
}

/// By physics where there is a task for it, and by what else says how good the design is, side by side.
void check(Run& run, const Scene* scene, const std::optional<PhysicsTask>& task, const RunOptions& options) {
  Judging judging(run, scene, options);
  std::future<void> beside = work_beside(judging, options.threads);
  std::optional<Verification> verification;
  if (task) verification = timed_physics(run, *task, options);
  options.progress(run.goal ? "prints, contact" : "contact", -1);
  judging.work();
  beside.get();
  add(judging.judgement(), run);
  if (!verification) return;
  add(std::move(*verification), *task, options, run);
  judge_by_physics(run, scene, options);
  if (!run.verification->agrees && run.verification->coarse) repeat_finer(run, scene, *task, options);
}

/// A goal counts in the state that its drive leads to: where the drive stops on its way there is none.
void judge_drive(Run& run) {
  if (run.goal && !run.matter && run.equilibrium && !run.equilibrium->reached())
    run.violations.push_back(drive_stop_reason(run.equilibrium->path));
}

/// However well the shape is kept: what tears does not keep it. After the physics run, which judges the shape alone.
void judge_strain(Run& run) {
  if (!run.goal || run.states.empty()) return;
  const auto why = strained_too_far(run.design, run.states.front().poses);
  if (!why) return;
  run.strained = run.met();
  run.violations.push_back(*why);
}

/// Shows the state that the search knows of its design, in place of a path that was stopped before its end.
void take_state_of_search(Run& run) {
  NamedState& shown = run.states.front();
  shown.poses = run.known->state;
  shown.model = to_string(run.known->model);
  shown.gaps = hinge_gaps(run.design.structure, shown.poses);
  run.theta = shown.theta = model::mean_theta(run.design.structure, shown.poses);
  run.plan.why.push_back("the path of the equilibrium was stopped: the state shown is that of the search");
}

/// Adds the states in which the model holds what was found, where it has any.
void add_states(Run& run, const RunOptions& options) {
  if (run.plan.model == Model::equilibrium) {
    add_equilibrium(run, drive_of(run.design), elasticity_of(run.design), motion_states, options);
    if (run.known && options.stop.stop_requested() && !run.equilibrium->reached()) take_state_of_search(run);
    run.own = run.states.front().poses;
  } else if (run.plan.exact) {
    if (!run.goal) run.theta = exact_theta_of(run.design, run.plan.exact);
    run.states.push_back(exact_state(run, "target", run.theta));
    run.fidelity.push_back(exact_fidelity(run.plan.exact, run.design.structure, run.theta));
    if (!run.goal) append(exact_frames(run), run.states);
  }
  append(std::move(run.notes), run.plan.why);
}

Run finished(Run run, const Scene* scene, const RunOptions& options) {
  const bool verifies = options.verify && !options.stop.stop_requested();
  check(run, scene, verifies ? physics_task(run) : std::nullopt, options);
  judge_strain(run);
  run.stopped = options.stop.stop_requested();
  if (scene && !run.matter && run.plan.model != Model::equilibrium) append(exact_frames(run), run.states);
  return run;
}

}  // namespace

Run held(Found found, const Scene* scene, const RunOptions& options) {
  Run run;
  run.seed = options.seed;
  Stopwatch watch;
  static_cast<Found&>(run) = planned(std::move(found));
  run.timings.plan = watch.lap();
  add_states(run, options);
  run.timings.equilibrium = watch.lap();
  if (!scene) return run;
  run.by_model = scene->measure(run, StateOf::model, run.own, options);
  run.violations = run.by_model->violations;
  run.prints_unknown = run.by_model->prints_unknown;
  return run;
}

Run settled(Run run, const Scene& scene, const RunOptions& options) {
  Stopwatch watch;
  if (is_of_matter(run)) settle_in_matter(run, scene, options);
  judge_drive(run);
  run.timings.matter = watch.lap();
  return run;
}

Run run_goal(const Scene& scene, const RunOptions& options) {
  Stopwatch watch;
  Found found = scene.search(options);
  found.design.name = scene.name;
  const double seconds = watch.lap();
  Run run = settled(held(std::move(found), &scene, options), scene, options);
  run.timings.optimise = seconds;
  return finished(std::move(run), &scene, options);
}

Run run_design(Design design, Model model, RunOptions options) {
  Found found;
  found.theta = design.theta;
  found.model = plan_model(design, model);
  found.design = std::move(design);
  Run run = held(std::move(found), nullptr, options);
  if (run.states.empty() && model == Model::exact)
    throw InvalidInput(run.plan.exact.why +
                       "; use --model equilibrium or bullet, which need no exact family");
  options.verify &= model == Model::bullet;
  return finished(std::move(run), nullptr, options);
}

}  // namespace kinetix::app
