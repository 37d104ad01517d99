#include "app/pipeline/pipeline.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/pipeline/as_made.hpp"
#include "app/pipeline/certify.hpp"
#include "app/pipeline/matter.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/pipeline/verify.hpp"
#include "app/run/stopwatch.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

/// What prints come to, of goals that are judged by distances.
void judge_prints(Run& run, const Scene& scene, const RunOptions& options) {
  if (!run.goal || run.states.empty() || options.stop.stop_requested()) return;
  if (run.matter && !run.equilibrium) {
    run.prints_unknown = "elastic hinges find no equilibrium near the design: " + run.matter->why;
    return;
  }
  const model::State state = run.matter ? run.equilibrium->path.state : scene.own_state(run);
  const auto judged = scene.judged(run, run.structure, run.theta, state);
  if (!judged) return;
  options.progress("prints", -1);
  run.printed = as_made(run, run.matter ? run.equilibrium->drive : drive_to(run.structure, run.theta), state,
                        judged->points, options.prints);
  if (run.printed)
    run.printed->tolerance_mm = judged->tolerance_mm;
  else
    run.prints_unknown = "elastic hinges have no stable state near the design under its drive";
  if (!run.printed) run.plan.why.push_back("what prints come to is not known: " + run.prints_unknown);
}

/// Puts right one end of a range whose samples have missed walls that touch before.
void correct(model::ThetaLimit& sampled, const model::CertifiedLimit& proven, Plan& plan) {
  if (!proven.contact || std::abs(sampled.theta) <= std::abs(*proven.contact)) return;
  plan.why.push_back(fmt::format("walls touch at theta {:.2f} deg already, and part again between samples",
                                 to_degrees(*proven.contact)));
  sampled = {proven.theta, true, proven.walls};
}

void correct_samples(Run& run) {
  if (!run.plan.free_range || !run.certified->designed) return;
  correct(run.plan.free_range->negative, run.certified->designed.negative, run.plan);
  correct(run.plan.free_range->positive, run.certified->designed.positive, run.plan);
}

/// Walls that do overlap on the way to a goal, whichever states its search has looked at.
void judge_contact(Run& run) {
  const model::CertifiedLimit& limit = run.certified->designed.to(run.theta);
  if (!run.goal || run.plan.model != Model::exact || !limit.contact ||
      std::abs(*limit.contact) >= std::abs(run.theta))
    return;
  const auto [first, second] = wall_names(limit, run.structure);
  run.goal->violations.push_back(
      fmt::format("walls {} and {} overlap at theta {:.3f} deg, on the way to {:.3f} deg", first, second,
                  to_degrees(*limit.contact), to_degrees(run.theta)));
}

std::optional<PhysicsTask> physics_task(const Run& run, const Scene& scene) {
  if (!run.matter || !run.equilibrium) return scene.physics_task(run);
  if (!run.equilibrium->reached()) return std::nullopt;
  const Equilibrium& equilibrium = *run.equilibrium;
  const sim::PhysicsOptions options =
      elastic_physics(equilibrium.elasticity, run.physics, run.structure.size().edge_mm, run.plan.planar,
                      equilibrium.drive.k_spring);
  return PhysicsTask{equilibrium.path.state, equilibrium.drive, options};
}

}  // namespace

Run run_scene(const Scene& scene, const RunOptions& options) {
  Run run;
  run.name = scene.name();
  run.seed = options.seed;
  Stopwatch watch;
  scene.solve(run, options);
  if (run.goal) run.own_hinges = own_hinges_of(run.structure, run.hinge_parts);
  if (run.goal) run.timings.optimise = watch.lap();
  run.plan = make_plan(run.structure, scene.model());
  run.timings.plan = watch.lap();
  scene.add_state(run, options);
  run.timings.equilibrium = watch.lap();
  scene.judge(run, options);
  watch.lap();
  if (is_of_matter(scene, run)) settle_in_matter(run, scene, options);
  run.timings.matter = watch.lap();
  judge_prints(run, scene, options);
  run.timings.as_made = watch.lap();
  if (options.certify && !options.stop.stop_requested()) {
    options.progress("contact", -1);
    run.certified = certify(run.structure, run.plan, run.process.sd);
    correct_samples(run);
    judge_contact(run);
  }
  run.timings.certify = watch.lap();
  if (options.verify && !options.stop.stop_requested())
    if (const auto task = physics_task(run, scene)) {
      verify(run, *task, options);
      if (run.verification && is_settled(*run.verification)) scene.judge_physics(run);
      if (run.verification && run.goal &&
          run.goal->violations.empty())  // of a state that misses its goal, physics says so too
        run.verification->agrees &= run.goal->physics_violations.empty();
      run.timings.verify = watch.lap();
    }
  run.stopped = options.stop.stop_requested();
  if (!run.matter) scene.add_frames(run);
  return run;
}

}  // namespace kinetix::app
