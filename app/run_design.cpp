#include "app/run_design.hpp"

#include "app/design_motion.hpp"
#include "app/stopwatch.hpp"
#include "app/verify.hpp"
#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

constexpr int frames = 13;

Run planned(const DesignFile& design, const RunOptions& options) {
  Run run;
  run.name = design.name;
  run.seed = options.seed;
  run.physics = design.physics;
  run.hinge = design.hinge;
  run.drive = design.drive;
  run.structure = design.structure;
  run.theta = design.theta;
  Stopwatch watch;
  run.plan = make_plan(run.structure);
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

}  // namespace

Run simulate_exact(const DesignFile& design, const RunOptions& options) {
  Run run = planned(design, options);
  if (run.plan.family.family == Family::none)
    throw InvalidInput(run.plan.family.why + "; use --model bullet, which asks for no family");
  add_exact_state(run, drive_of(design));
  for (NamedState& frame : motion_frames(run.plan.family, run.structure, run.theta, frames))
    run.states.push_back(std::move(frame));
  return run;
}

Run simulate_physics(const DesignFile& design, const RunOptions& options) {
  if (design.hinge.model == HingeSection::Model::elastic)
    throw InvalidInput("elastic hinges are not simulated by this version; allowed: rotary",
                       {"", 0, 0, "hinge.model"});
  const bool exact = classify(design.structure).family != Family::none;
  Run run = exact ? simulate_exact(design, options) : planned(design, options);
  const Drive drive = drive_of(design);
  PhysicsOptions physics = physics_options(design.physics, design.structure.size.edge_mm);
  if (design.hinge.reach_mm) physics.reach = *design.hinge.reach_mm / design.structure.size.edge_mm;
  Stopwatch watch;
  const State reference = exact ? run.states.front().poses : State{};
  verify(run, reference, drive, physics, options.progress);
  run.timings.verify = watch.lap();
  return run;
}

}  // namespace kinetix
