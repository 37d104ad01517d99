#include "app/pipeline/pipeline.hpp"

#include <future>
#include <utility>

#include "app/pipeline/judgement.hpp"
#include "app/pipeline/matter.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/pipeline/verify.hpp"
#include "app/run/design_hinges.hpp"
#include "app/run/drive_end.hpp"
#include "app/run/stopwatch.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

std::optional<PhysicsTask> physics_task(const Run& run, const Scene& scene) {
  if (!run.matter || !run.equilibrium) return scene.physics_task(run);
  if (!run.equilibrium->reached()) return std::nullopt;
  const Equilibrium& equilibrium = *run.equilibrium;
  const sim::PhysicsOptions options =
      elastic_physics(equilibrium.elasticity, run.design.physics, run.design.structure.size().edge_mm,
                      run.plan.planar, equilibrium.drive.k_spring);
  return PhysicsTask{equilibrium.path.state, equilibrium.drive, options};
}

/// On a thread of its own where there may be one and the system gives it.
std::future<void> work_beside(Judging& judging, int threads) {
  const auto policy =
      model::threads_of(threads) > 1 ? std::launch::async | std::launch::deferred : std::launch::deferred;
  return std::async(policy, [&judging] { judging.work(); });
}

void judge_by_physics(Run& run, const Scene& scene) {
  if (is_settled(*run.verification)) scene.judge_physics(run);
  if (run.goal && run.goal->violations.empty())  // of a state that misses its goal, physics says so too
    run.verification->agrees &= run.goal->physics_violations.empty();
}

std::optional<Verification> timed_physics(Run& run, const PhysicsTask& task, const RunOptions& options,
                                          bool usual_steps = false) {
  Stopwatch watch;
  std::optional<Verification> out = verify(run, task, options, usual_steps);
  run.timings.verify += watch.lap();
  return out;
}

/// Where coarser steps came near enough to the model's state, but not to the goal, which may be stricter.
void repeat_finer(Run& run, const Scene& scene, const PhysicsTask& task, const RunOptions& options) {
  const double spent = run.verification->physics.seconds;
  remove_coarse(run);
  std::optional<Verification> finer = timed_physics(run, task, options, true);
  if (!finer) return;
  finer->physics.seconds += spent;
  add(std::move(*finer), task, options, run);
  judge_by_physics(run, scene);
}

/// By physics where there is a task for it, and by what else says how good the design is, side by side.
void check(Run& run, const Scene& scene, const std::optional<PhysicsTask>& task, const RunOptions& options) {
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
  judge_by_physics(run, scene);
  if (!run.verification->agrees && run.verification->coarse) repeat_finer(run, scene, *task, options);
}

/// A goal counts in the state that its drive leads to: where the drive stops on its way there is none.
void judge_drive(Run& run) {
  if (run.goal && !run.matter && run.equilibrium && !run.equilibrium->reached())
    run.goal->violations.push_back(drive_stop_reason(run.equilibrium->path));
}

/// However well the shape is kept: what tears does not keep it. After the physics run, which judges the shape alone.
void judge_strain(Run& run) {
  if (!run.goal || run.states.empty()) return;
  const auto why = strained_too_far(run.design, run.states.front().poses);
  if (!why) return;
  run.goal->strained = run.goal->met();
  run.goal->violations.push_back(*why);
}

}  // namespace

Run run_scene(const Scene& scene, const RunOptions& options) {
  Run run;
  run.design.name = scene.name();
  run.seed = options.seed;
  Stopwatch watch;
  scene.solve(run, options);
  if (run.goal) run.design.own_hinges = own_hinges_of(run.design.structure, run.hinge_parts);
  if (run.goal) run.timings.optimise = watch.lap();
  run.plan = make_plan(run.design.structure, scene.model());
  run.timings.plan = watch.lap();
  scene.add_state(run, options);
  run.timings.equilibrium = watch.lap();
  scene.judge(run, options);
  watch.lap();
  if (is_of_matter(scene, run)) settle_in_matter(run, scene, options);
  judge_drive(run);
  run.timings.matter = watch.lap();
  const bool verifies = options.verify && !options.stop.stop_requested();
  check(run, scene, verifies ? physics_task(run, scene) : std::nullopt, options);
  judge_strain(run);
  run.stopped = options.stop.stop_requested();
  if (!run.matter) scene.add_frames(run);
  return run;
}

}  // namespace kinetix::app
