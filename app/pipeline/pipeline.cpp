#include "app/pipeline/pipeline.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include "app/pipeline/body_pieces.hpp"
#include "app/pipeline/closed_way.hpp"
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
#include "model/base/append.hpp"
#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

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
  const bool on_the_way = (run.equilibrium && !run.equilibrium->reached()) || (run.way && !run.way->reached);
  return run.states.empty() || on_the_way ? model::State{} : run.states.front().poses;
}

/// Of a design: the file's drive. Imported bodies collide by their pieces.
PhysicsTask design_task(const Run& run) {
  PhysicsTask task{reference_of(run), drive_of(run.design), physics_of(run.design, run.plan.planar)};
  task.pull = pull_of(run.design);
  if (run.pieces)
    task.parts = std::make_shared<const sim::ContactParts>(
        contact_parts(*run.pieces, *run.design.structure.assembly()));
  return task;
}

std::optional<PhysicsTask> physics_task(const Run& run) {
  if (!run.goal) return design_task(run);
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

/// How the settled physics run keeps the goal.
std::shared_ptr<const Measure> measured(const Run& run, const Goal* goal, const Verification& verification,
                                        const RunOptions& options) {
  if (!goal || !is_settled(verification)) return nullptr;
  return goal->measure(run, StateOf::physics, verification.physics.state, options);
}

/// Of a state that misses its goal, physics says so too.
bool agrees(const Run& run, const Verification& verification, const Measure* measure) {
  return verification.agrees && (!measure || !run.met() || measure->violations.empty());
}

/// Runs the physics engine. Where coarser steps came near enough to the model's state, but not to the goal, which may be stricter,
/// it runs again in the usual ones.
Run with_physics(Run run, const Goal* goal, Verification verification, const PhysicsTask& task,
                 const RunOptions& options) {
  std::shared_ptr<const Measure> measure = measured(run, goal, verification, options);
  if (verification.coarse && !agrees(run, verification, measure.get())) {
    Stopwatch watch;
    std::optional<Verification> finer = verify(run, task, options, true);
    run.timings.verify += watch.lap();
    if (!finer) return run;
    finer->physics.seconds += verification.physics.seconds;
    verification = std::move(*finer);
    measure = measured(run, goal, verification, options);
  }
  verification.agrees = agrees(run, verification, measure.get());
  const sim::PhysicsResult& physics = verification.physics;
  run.states.push_back({"target", to_string(Model::bullet), run.theta,
                        measure && measure->shown ? *measure->shown : physics.state, physics.gaps});
  model::append(fidelity_of(run, verification, task, options), run.fidelity);
  run.by_physics = std::move(measure);
  run.verification = std::move(verification);
  return run;
}

/// A goal counts in the state that its drive leads to: where the drive stops on its way there is none.
std::optional<std::string> why_drive_stops(const Run& run) {
  if (!run.goal || run.matter || !run.equilibrium || run.equilibrium->reached()) return std::nullopt;
  return drive_stop_reason(run.equilibrium->path);
}

/// The goal is missed where a hinge tears in the state shown, however well the shape is kept.
Run with_strain(Run run) {
  const auto why =
      run.goal && !run.states.empty() ? strained_too_far(run.design, run.states.front().poses) : std::nullopt;
  if (!why) return run;
  run.strained = run.met();
  run.violations.push_back(*why);
  return run;
}

/// The state that the search knows of its design, in place of a path that was stopped before its end.
NamedState known_state(const Run& run) {
  const model::State& state = run.known->state;
  return {"target", to_string(run.known->model), model::mean_theta(run.design.structure, state), state,
          hinge_gaps(run.design.structure, state)};
}

/// The states in which the model holds what was found, where it has any.
Run with_model_states(Run run, const RunOptions& options) {
  if (run.design.structure.assembly()) return with_closed_way(std::move(run), options);
  if (run.plan.model == Model::equilibrium) {
    ElasticState state =
        follow_drive(run, drive_of(run.design), elasticity_of(run.design), motion_states, options);
    run = with_states(std::move(run), std::move(state));
    if (run.known && options.stop.stop_requested() && !run.equilibrium->reached()) {
      run.states.front() = known_state(run);
      run.theta = run.states.front().theta;
      run.plan.why.emplace_back(
          "the path of the equilibrium was stopped: the state shown is that of the search");
    }
    run.own = run.states.front().poses;
  } else if (run.plan.exact) {
    if (!run.goal) run.theta = exact_theta_of(run.design, run.plan.exact);
    run.states.push_back(exact_state(run, "target", run.theta));
    if (options.brief) return run;
    run.fidelity.push_back(exact_fidelity(run.plan.exact, run.design.structure, run.theta));
    if (!run.goal) model::append(exact_frames(run), run.states);
  }
  model::append(run.notes, run.plan.why);
  return run;
}

/// One run, from what was found to what every model says of it. @param goal null for a design
Run run_found(Found found, const Goal* goal, const RunOptions& options) {
  Run run = held(std::move(found), goal, options);
  if (goal) run = settled(std::move(run), *goal, options);
  const bool simulates = options.verify && !options.stop.stop_requested();
  if (simulates && run.way) run = with_pieces(std::move(run), options);
  const std::optional<PhysicsTask> task = simulates ? physics_task(run) : std::nullopt;

  Judging judging(run, goal, options);
  std::future<void> beside = work_beside(judging, options.threads);
  Stopwatch watch;
  std::optional<Verification> simulated;
  if (task) simulated = verify(run, *task, options);
  const double seconds = watch.lap();
  options.progress(run.goal ? "prints, contact" : "contact", -1);
  judging.work();
  beside.get();

  run = with_judgement(std::move(run), judging.judgement());
  if (task) run.timings.verify = seconds;
  if (simulated) run = with_physics(std::move(run), goal, std::move(*simulated), *task, options);
  run = with_strain(std::move(run));
  run.stopped = options.stop.stop_requested();
  if (goal && !run.matter && run.plan.model != Model::equilibrium)
    model::append(exact_frames(run), run.states);
  return run;
}

}  // namespace

Run held(Found found, const Goal* goal, const RunOptions& options) {
  Run run;
  run.seed = options.seed;
  Stopwatch watch;
  static_cast<Found&>(run) = planned(std::move(found), options.brief);
  run.timings.plan = watch.lap();
  run = with_model_states(std::move(run), options);
  run.timings.equilibrium = watch.lap();
  if (!goal) return run;
  run.by_model = goal->measure(run, StateOf::model, run.own, options);
  run.violations = run.by_model->violations;
  run.prints_unknown = run.by_model->prints_unknown;
  return run;
}

Run settled(Run run, const Goal& goal, const RunOptions& options) {
  Stopwatch watch;
  if (is_of_matter(run)) run = settled_in_matter(std::move(run), goal, options);
  if (const auto why = why_drive_stops(run)) run.violations.push_back(*why);
  run.timings.matter = watch.lap();
  return run;
}

Run run_goal(const Goal& goal, const RunOptions& options) {
  Stopwatch watch;
  Found found = goal.search(options);
  found.design.name = goal.name;
  const double seconds = watch.lap();
  Run run = run_found(std::move(found), &goal, options);
  run.timings.optimise = seconds;
  return run;
}

Run run_design(Design design, Model model, RunOptions options) {
  const bool is_sheet = !design.structure.assembly();
  options.verify &= model == Model::bullet;
  options.certify &= is_sheet;
  Found found;
  found.theta = design.theta;
  found.model = plan_model(design, model);
  if (model == Model::exact && is_sheet) found.plan.exact = exact_motion(design.structure);
  if (model == Model::exact && is_sheet && !found.plan.exact)
    throw InvalidInput(found.plan.exact.why +
                       "; use --model equilibrium or bullet, which need no exact family");
  found.design = std::move(design);
  return run_found(std::move(found), nullptr, options);
}

}  // namespace kinetix::app
