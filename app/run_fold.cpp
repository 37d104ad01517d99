#include "app/run_fold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/design_motion.hpp"
#include "app/stopwatch.hpp"
#include "app/verify.hpp"

namespace kinetix {
namespace {

constexpr int frames = 13;

FoldOptions search_of(const FoldFile& file) {
  FoldOptions options;
  options.size = file.size;
  options.tilt = file.tilt;
  options.theta = file.theta;
  return options;
}

/// What a state lacks of what the file asks.
std::vector<std::string> misses(const FoldFile& file, const FoldNet& net, const FoldError& error,
                                const std::string& who) {
  std::vector<std::string> why;
  for (std::size_t c = 0; c < net.creases.size(); ++c)
    if (!(std::abs(error.fold[c] - net.creases[c].angle) <= file.angle_tolerance))
      why.push_back(fmt::format("{}: crease `{}` folds by {:.2f} deg, asked are {:.2f}", who,
                                crease_name(net, net.creases[c]), to_degrees(error.fold[c]),
                                to_degrees(net.creases[c].angle)));
  if (!(error.rms <= file.shape_tolerance))
    why.push_back(fmt::format("{}: faces are off the solid by {:.3g} of their edge, allowed are {:.3g}", who,
                              error.rms, file.shape_tolerance));
  return why;
}

/// The physics run, and how its last state keeps the goal.
void verify_fold(Run& run, const FoldFile& file, const State& exact, const Progress& progress) {
  verify(run, exact, drive_to(run.structure, run.theta), physics_options(file.physics, file.size.edge_mm),
         progress);
  Verification& v = *run.verification;
  if (v.physics.status != PhysicsResult::Status::settled) return;
  FoldOutcome& fold = *run.fold;
  const FoldedNet& net = fold.design.folded;
  fold.physics = fold_error(net.net, net.layout, run.structure, v.physics.state, run.theta);
  fold.why_physics = misses(file, net.net, *fold.physics, "physics run");
  v.agrees = v.agrees && fold.why_physics.empty();
}

}  // namespace

Run run_fold(const FoldFile& file, const RunOptions& options) {
  Run run;
  run.name = file.name;
  run.seed = options.seed;
  run.physics = file.physics;
  run.shape_tolerance = file.shape_tolerance;
  run.verify_tolerance = file.verify_tolerance;

  Stopwatch watch;
  FoldOutcome fold{file.goal, fit_fold(file.goal, search_of(file), options.progress), {}, {}, {}};
  run.timings.optimise = watch.lap();

  const FoldedNet& net = fold.design.folded;
  run.structure = net.structure;
  run.theta = net.theta;
  run.plan = make_plan(run.structure);
  run.timings.plan = watch.lap();
  fold.why_missed = fold.design.obstacles;
  if (fold.design.folds) fold.why_missed = misses(file, net.net, net.error, "model");
  run.fold = std::move(fold);

  const State exact = kinetix::fold(run.plan.family, run.structure, run.theta);
  run.states.push_back({"target", "exact", run.theta, exact, hinge_gaps(run.structure, exact)});
  run.fidelity.push_back(exact_fidelity(run.plan.family, run.structure, run.theta));
  if (options.verify && run.fold->met()) {
    verify_fold(run, file, exact, options.progress);
    run.timings.verify = watch.lap();
  }
  for (NamedState& frame : motion_frames(run.plan.family, run.structure, run.theta, frames))
    run.states.push_back(std::move(frame));
  return run;
}

}  // namespace kinetix
