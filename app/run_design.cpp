#include "app/run_design.hpp"

#include "app/balance.hpp"
#include "app/design_motion.hpp"
#include "app/stopwatch.hpp"
#include "app/verify.hpp"
#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

constexpr int frames = 13;

Run planned(const DesignFile& design, const RunOptions& options, std::optional<Model> model = {}) {
  Run run;
  run.name = design.name;
  run.seed = options.seed;
  run.physics = design.physics;
  run.hinge = design.hinge;
  run.drive = design.drive;
  run.side = design.side;
  run.structure = design.structure;
  run.theta = design.theta;
  Stopwatch watch;
  run.plan = make_plan(run.structure, model);
  run.timings.plan = watch.lap();
  return run;
}

/// The state of the closed form that the drive leads to.
const State& add_exact_state(Run& run, const Drive& drive) {
  run.theta = theta_of(drive, run.plan.family, run.structure);
  State state = fold(run.plan.family, run.structure, run.theta);
  const HingeGaps gaps = hinge_gaps(run.structure, state);
  run.states.push_back({"target", "exact", run.theta, std::move(state), gaps});
  run.fidelity.push_back(exact_fidelity(run.plan.family, run.structure, run.theta));
  return run.states.back().poses;
}

/// The model's run that a physics run is compared with.
Run reference_run(const DesignFile& design, const RunOptions& options) {
  if (design.hinge.model == HingeSection::Model::elastic) return simulate_equilibrium(design, options);
  const bool exact = classify(design.structure).family != Family::none;
  return exact ? simulate_exact(design, options) : planned(design, options);
}

/// The state to compare with; empty where there is none of the whole drive.
State reference_of(const Run& run) {
  const bool on_the_way = run.equilibrium && !run.equilibrium->reached();
  return run.states.empty() || on_the_way ? State{} : run.states.front().poses;
}

}  // namespace

Run simulate_exact(const DesignFile& design, const RunOptions& options) {
  Run run = planned(design, options);
  if (run.plan.family.family == Family::none)
    throw InvalidInput(run.plan.family.why + "; use --model equilibrium or bullet, which ask for no family");
  add_exact_state(run, drive_of(design));
  for (NamedState& frame : motion_frames(run.plan.family, run.structure, run.theta, frames))
    run.states.push_back(std::move(frame));
  return run;
}

Run simulate_equilibrium(const DesignFile& design, const RunOptions& options) {
  Run run = planned(design, options, Model::equilibrium);
  Stopwatch watch;
  add_balance(run, drive_of(design), elasticity_of(design), frames, options.progress);
  run.timings.balance = watch.lap();
  return run;
}

Run simulate_physics(const DesignFile& design, const RunOptions& options) {
  Run run = reference_run(design, options);
  const PhysicsOptions physics = physics_of(design, run.plan.planar);
  Stopwatch watch;
  verify(run, reference_of(run), drive_of(design), physics, options.progress);
  run.timings.verify = watch.lap();
  return run;
}

}  // namespace kinetix
