#include "app/pipeline/pipeline.hpp"

#include "app/pipeline/as_made.hpp"
#include "app/pipeline/verify.hpp"
#include "app/run/stopwatch.hpp"

namespace kinetix::app {

Run run_scene(const Scene& scene, const RunOptions& options) {
  Run run;
  run.name = scene.name();
  run.seed = options.seed;
  Stopwatch watch;
  scene.solve(run, options);
  if (run.goal) run.timings.optimise = watch.lap();
  run.plan = make_plan(run.structure, scene.model());
  run.timings.plan = watch.lap();
  scene.add_state(run, options);
  run.timings.equilibrium = watch.lap();
  scene.judge(run, options);
  watch.lap();
  if (const auto judged = scene.judged_points(run)) {
    run.printed = as_made(run, judged->drive, judged->points, options.prints);
    if (run.printed)
      run.printed->tolerance_mm = judged->tolerance_mm;
    else
      run.plan.why.push_back(
          "what prints come to is not known: elastic hinges have no stable state near the design under its "
          "drive");
  }
  run.timings.as_made = watch.lap();
  if (options.verify)
    if (const auto task = scene.physics_task(run)) {
      verify(run, *task, options.progress);
      if (is_settled(*run.verification)) scene.judge_physics(run);
      if (run.goal && run.goal->violations.empty())  // of a state that misses its goal, physics says so too
        run.verification->agrees &= run.goal->physics_violations.empty();
      run.timings.verify = watch.lap();
    }
  scene.add_frames(run);
  return run;
}

}  // namespace kinetix::app
