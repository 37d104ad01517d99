#include "app/run_helmet.hpp"

#include <fmt/format.h>

#include "app/design_motion.hpp"
#include "app/stopwatch.hpp"
#include "app/verify.hpp"

namespace kinetix {
namespace {

using Eigen::Vector3d;

constexpr int frames = 13;
constexpr int default_evaluations = 120;
const Vector3d crown = Vector3d::Zero();  // origin of the head's frame

SolverOptions search_of(const HelmetFile& file) {
  SolverOptions options;
  options.max_evaluations = file.solver.max_evaluations.value_or(default_evaluations);
  return options;
}

State in_mesh(const Head& head, State state) {
  for (Pose& pose : state) pose = {head.to_mesh.linear() * pose.R, head.to_mesh * pose.p};
  return state;
}

std::vector<std::string> misses(const HelmetFile& file, const HelmetError& error, const std::string& who) {
  std::vector<std::string> why;
  if (!(error.rms <= file.rms_mm))
    why.push_back(fmt::format("{}: {:.2f} mm rms from head plus clearance, asked are {:g} mm", who, error.rms,
                              file.rms_mm));
  if (!(error.max <= file.max_mm))
    why.push_back(fmt::format("{}: up to {:.2f} mm from head plus clearance, asked are {:g} mm", who,
                              error.max, file.max_mm));
  return why;
}

std::vector<std::string> why_missed(const HelmetFile& file, const HelmetDesign& design, const Plan& plan) {
  std::vector<std::string> why = misses(file, design.error, "model");
  why.insert(why.end(), design.collisions.begin(), design.collisions.end());
  if (plan.free_range && plan.free_range->positive.touches &&
      !(design.shape.theta <= plan.free_range->positive.theta))
    why.push_back(fmt::format(
        "walls collide on the way, at theta {:.2f} deg: use lower or thinner walls, or fewer ribs",
        to_degrees(plan.free_range->positive.theta)));
  return why;
}

void verify_helmet(Run& run, const HelmetFile& file, const State& folded, const RunOptions& options) {
  verify(run, folded, drive_to(run.structure, run.theta),
         physics_options(file.physics, file.wish.size.edge_mm), options.progress);
  Verification& v = *run.verification;
  if (v.physics.status != PhysicsResult::Status::settled) return;
  HelmetOutcome& helmet = *run.helmet;
  const State on_head = aligned(v.physics.state, helmet.design.state);
  run.states.back().poses = in_mesh(helmet.head, on_head);
  helmet.physics = helmet_error(helmet.design.fishbone, on_head, helmet.head.dome, file.wish.clearance_mm);
  helmet.why_physics = misses(file, *helmet.physics, "physics run");
  v.agrees = v.agrees && helmet.why_physics.empty();
}

void add_frames(Run& run) {
  const HelmetOutcome& helmet = *run.helmet;
  for (int k = 0; k < frames; ++k) {
    const double theta = run.theta * k / (frames - 1);
    State state = placed_fishbone(helmet.design.fishbone, helmet.design.shape, theta);
    const HingeGaps gaps = hinge_gaps(run.structure, state);
    run.states.push_back({"frame", "exact", theta, in_mesh(helmet.head, std::move(state)), gaps});
  }
}

}  // namespace

Run run_helmet(const HelmetFile& file, const RunOptions& options) {
  Run run;
  run.name = file.name;
  run.seed = options.seed;
  run.physics = file.physics;
  run.verify_tolerance = file.verify;

  Stopwatch watch;
  if (options.progress) options.progress("search", 0);
  const SolverOptions search = search_of(file);
  HelmetOutcome helmet{
      .head = file.head, .wish = file.wish, .design = fit_helmet(file.head.dome, crown, file.wish, search)};
  run.timings.optimise = watch.lap();
  helmet.uniform = fit_uniform_helmet(helmet.design, file.head.dome, crown, file.wish, search);

  run.structure = helmet.design.fishbone.structure;
  run.theta = helmet.design.shape.theta;
  run.plan = make_plan(run.structure);
  run.timings.plan = watch.lap();
  helmet.why_missed = why_missed(file, helmet.design, run.plan);
  run.helmet = std::move(helmet);

  const State& folded = run.helmet->design.state;
  run.states.push_back(
      {"target", "exact", run.theta, in_mesh(file.head, folded), hinge_gaps(run.structure, folded)});
  run.fidelity.push_back(exact_fidelity(run.plan.family, run.structure, run.theta));
  if (options.verify) {
    verify_helmet(run, file, folded, options);
    run.timings.verify = watch.lap();
  }
  add_frames(run);
  return run;
}

}  // namespace kinetix
