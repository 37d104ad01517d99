#include "app/pipeline/pipeline.hpp"

#include <fmt/format.h>
#include <atomic>
#include <future>

#include "app/pipeline/closed_form.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/imported_bodies.hpp"
#include "app/pipeline/physics.hpp"
#include "app/pipeline/print_tolerance.hpp"
#include "app/run/design_hinges.hpp"
#include "model/base/algorithms.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app {
namespace {

/// Results of the checks that run in parallel with the simulation.
struct CheckResults {
  std::optional<PrintedGoal> printed;     ///< only of goals that are judged by distances
  std::string prints_unknown;             ///< why such a goal has none, else empty
  std::optional<ProvenRanges> certified;  ///< if the options request it
  std::optional<PrintAnswer> print;       ///< answer of `export`, for goals if the options request it
  std::optional<LockKind> lock;           ///< that it would print; empty if the goal names one
  double print_tolerance_s = 0, certify_s = 0;
};

/// Checks of a run in parts: prints, contact of walls, answer of `export`. Threads take parts as they become free.
/// The run is read only, so a simulation may run in parallel.
class ParallelChecks {
 public:
  /// @param run, options are kept by reference   @param goal null for a design
  /// @pre the run has its plan, its state and, of elastic hinges, its equilibrium
  ParallelChecks(const Run& run, const Goal* goal, const RunOptions& options);
  /// Works on parts that no thread has begun, until none is left or the options request a stop. Any number of threads
  /// may call it.
  void work();
  /// @pre every work() has returned
  const CheckResults& check_results() const { return found_; }

 private:
  void check_prints();
  void prove_range();
  void check_export();

  const Run& run_;
  const Goal* goal_;
  const RunOptions& options_;
  std::atomic<int> begun_ = 0;
  CheckResults found_;  ///< each part writes different fields
};

/// Corrects one end of a sampled range if walls provably touch before it.
void correct(model::ContactLimit& sampled, const model::ContactLimit& proven, Plan& plan) {
  if (!proven.contact || std::abs(sampled.theta) <= std::abs(*proven.contact)) return;
  plan.why.push_back(
      fmt::format("walls already touch at a fold angle of {:.2f} deg, and part again between two samples",
                  to_degrees(*proven.contact)));
  sampled = proven;
}

Plan corrected(Plan plan, const ProvenRanges& certified) {
  if (!plan.free_range || !certified.designed) return plan;
  correct(plan.free_range->negative, certified.designed.negative, plan);
  correct(plan.free_range->positive, certified.designed.positive, plan);
  return plan;
}

/// Describes walls that overlap during the motion to a goal, whatever states its search has checked. If no proof was
/// requested, only walls that overlap as built are found, in the flat state. Empty if none are found.
std::optional<std::string> describe_wall_overlap(const Run& run) {
  if (!run.goal || run.plan.model != Model::exact) return std::nullopt;
  if (run.certified) return run.certified->designed ? contact_reason(run) : std::nullopt;
  if (!run.plan.exact || run.theta == 0) return std::nullopt;
  const model::Linkage linkage = run.design.structure;
  const model::WallContact contact(linkage);
  const auto& overlap = contact.overlap_at_rest();
  return overlap ? std::optional(describe_overlap(*overlap, run.design.structure)) : std::nullopt;
}

/// Whether prints are free of contact in the states in which they are judged; empty if that is not known. Nothing is
/// proven of equilibria near the closed form. A contact of the closed form counts for them all the same, as a
/// warning.
std::optional<bool> are_prints_free(const Run& run) {
  const bool has_left = run.equilibrium && run.equilibrium->path.off_closed_form;
  if (!run.printed || !run.certified || has_left || !run.certified->printed) return std::nullopt;
  const bool is_free = run.certified->printed.covers(run.theta) && !run.printed->touches_too_often();
  return run.equilibrium && is_free ? std::nullopt : std::optional(is_free);
}

ParallelChecks::ParallelChecks(const Run& run, const Goal* goal, const RunOptions& options)
    : run_(run), goal_(goal), options_(options) {}

void ParallelChecks::work() {
  constexpr std::array parts{&ParallelChecks::check_prints, &ParallelChecks::prove_range,
                             &ParallelChecks::check_export};
  for (int k = begun_++; k < static_cast<int>(parts.size()); k = begun_++)
    if (!options_.stop.stop_requested() || parts[k] == &ParallelChecks::check_export) (this->*parts[k])();
}

void ParallelChecks::check_prints() {
  if (!goal_ || run_.states.empty()) return;
  if (run_.compensation && !run_.equilibrium) {
    found_.prints_unknown = "elastic hinges find no equilibrium near the design: " + run_.compensation->why;
    return;
  }
  Stopwatch watch;
  const model::State& state = run_.compensation ? run_.equilibrium->path.state : run_.own;
  const auto observed = goal_->observe(run_, run_.design.structure, state);
  if (!observed) return;
  found_.printed = analyse_print_tolerance(
      run_, run_.compensation ? run_.equilibrium->drive : drive_to(run_.design.structure, run_.theta), state,
      observed->points, options_);
  if (found_.printed)
    found_.printed->tolerance_mm = observed->tolerance_mm;
  else
    found_.prints_unknown = "elastic hinges have no stable state near the design under its drive";
  found_.print_tolerance_s = watch.lap();
}

void ParallelChecks::prove_range() {
  if (!options_.certify) return;
  Stopwatch watch;
  found_.certified =
      certify(run_.design.structure, run_.plan, wall_error(run_.design), options_.threads, options_.stop);
  found_.certify_s = watch.lap();
}

/// Checks whether soft hinges have a stable state near the one that their drive leads to. The first one is flat.
bool is_stable_when_released(const Equilibrium& found, const model::Lattice& sheet) {
  constexpr double near = 0.05;  // cell edges, rms
  for (std::size_t k = 1; k < found.stable.states.size(); ++k)
    if (aligned_distance(sheet, found.stable.states[k].state, found.path.state).rms < near) return true;
  return false;
}

/// Checks whether a print has no lock without a warning. Cut sheets have no posts. A fold may stay without a lock: by
/// springs, by a cord that is tied, or by soft hinges that are stable there.
bool needs_no_lock(const Run& run) {
  const bool has_springs =
      (run.folding && run.folding->is_unaided) || (run.equilibrium && !run.equilibrium->drive.is_external());
  const bool has_cord = run.design.drive && std::holds_alternative<model::CordPull>(*run.design.drive);
  return run.theta == 0 || run.design.process.cuts_sheets() || has_springs || has_cord ||
         (run.equilibrium && is_stable_when_released(*run.equilibrium, run.design.structure));
}

/// Adds the default lock to a print: a clip, else a strap, if it needs one.
PrintAnswer with_default_lock(const Run& run, PrintAnswer print) {
  if (needs_no_lock(run)) return print;
  print.lock = print.add_lock();
  if (!print.lock)
    print.warning =
        "nothing holds the fold: no clip or strap fits. Tie or glue the folded sheet; `lock: none` turns "
        "this warning off";
  return print;
}

LockKind kind_of_lock(const std::optional<Lock>& lock) {
  if (!lock) return LockKind::none;
  return lock->kind == to_string(LockKind::clip) ? LockKind::clip : LockKind::strap;
}

void ParallelChecks::check_export() {
  if (!run_.goal || run_.states.empty() || !options_.printable) return;
  // A stopped run still has the lock of the print that it found: design.yaml is then complete.
  if (!run_.print && options_.stop.stop_requested()) return;
  PrintAnswer answer = run_.print ? *run_.print : options_.printable(written_design(run_));
  if (answer.add_lock && !run_.design.lock) {
    answer = with_default_lock(run_, std::move(answer));
    found_.lock = kind_of_lock(answer.lock);
  }
  found_.print = std::move(answer);
}

/// Adds the judgement to the run. A sampled range of theta ends where walls provably meet, and a goal beyond that is
/// missed. A goal whose walls overlap as built is missed even if no proof was requested.
Run with_check_results(Run run, CheckResults check_results) {
  run.timings.print_tolerance = check_results.print_tolerance_s;
  run.timings.certify = check_results.certify_s;
  if (check_results.print) run.print = std::move(check_results.print);
  if (check_results.lock) run.design.lock = check_results.lock;
  if (check_results.printed) {
    run.printed = std::move(check_results.printed);
    if (run.print) run.printed->can_be_printed = run.print->is_accepted;
  }
  if (!check_results.prints_unknown.empty()) {
    run.prints_unknown = std::move(check_results.prints_unknown);
    run.plan.why.push_back("print tolerance is unknown: " + run.prints_unknown);
  }
  run.certified = std::move(check_results.certified);
  if (run.certified) run.plan = corrected(std::move(run.plan), *run.certified);
  if (const auto why = describe_wall_overlap(run)) run.violations.push_back(*why);
  if (const auto free = are_prints_free(run)) run.printed->free_of_contact = *free;
  return run;
}

/// Returns the simulation of elastic hinges in equilibrium; empty if the drive did not reach its goal.
std::optional<PhysicsTask> elastic_task(const Run& run) {
  const Equilibrium& equilibrium = *run.equilibrium;
  if (!equilibrium.reached()) return std::nullopt;
  const sim::PhysicsOptions options =
      elastic_physics(equilibrium.elasticity, run.design.physics, run.design.structure.size().edge_mm,
                      run.plan.planar, equilibrium.drive.k_spring);
  return PhysicsTask{equilibrium.path.state, equilibrium.drive, options};
}

/// Returns the state that a design's simulation is compared with; empty if there is none for the whole drive.
model::State reference_of(const Run& run) {
  const bool is_incomplete =
      (run.equilibrium && !run.equilibrium->reached()) || (run.closed_path && !run.closed_path->reached);
  return run.states.empty() || is_incomplete ? model::State{} : run.states.front().poses;
}

/// Returns the simulation of a design, with the file's drive. Imported bodies collide by their pieces.
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
  const PhysicsRequest& wish = run.physics;
  if (wish.when == PhysicsRequest::When::never) return std::nullopt;
  if (run.equilibrium) return elastic_task(run);
  if (wish.when == PhysicsRequest::When::if_met && !run.met()) return std::nullopt;
  sim::PhysicsOptions options =
      rotary_physics(run.design.hinge, run.design.physics, run.design.structure.size().edge_mm);
  options.settle_seconds = std::max(options.settle_seconds, wish.min_settle_s);
  return PhysicsTask{run.own, wish.drive ? *wish.drive : drive_to(run.design.structure, run.theta), options};
}

/// Starts the checks in a separate thread if the run and the system allow one. Otherwise get() of the result runs
/// them.
std::future<void> work_beside(ParallelChecks& parallel_checks, int threads) {
  const auto policy =
      model::threads_of(threads) > 1 ? std::launch::async | std::launch::deferred : std::launch::deferred;
  return std::async(policy, [&parallel_checks] { parallel_checks.work(); });
}

/// Measures the settled simulation against the goal. Null without a goal or if it did not settle.
std::shared_ptr<const Measure> measured(const Run& run, const Goal* goal, const Verification& verification,
                                        const RunOptions& options) {
  if (!goal || !is_settled(verification)) return nullptr;
  return goal->measure(run, StateOf::physics, verification.physics.state, options);
}

/// Whether the simulation agrees with the run in its state and, if the run meets its goal, in meeting it.
bool agrees(const Run& run, const Verification& verification, const Measure* measure) {
  return verification.agrees && (!measure || !run.met() || measure->violations.empty());
}

/// Adds a simulation to the run. Larger time steps may reach the model's state within tolerance, but miss the goal,
/// which may be stricter. Then the simulation is repeated with the usual steps.
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

/// Returns why the drive of a goal stops before its end; empty if it does not. A goal counts only in the state at the
/// end of its drive.
std::optional<std::string> describe_drive_stop(const Run& run) {
  if (!run.goal || run.compensation || !run.equilibrium || run.equilibrium->reached()) return std::nullopt;
  return drive_stop_reason(run.equilibrium->path);
}

/// Adds a violation of the goal if a hinge is overstrained in the state shown, even if the shape is right.
Run with_strain(Run run) {
  const auto why = run.goal && !run.states.empty() ? describe_overstrain(run.design, run.states.front().poses)
                                                   : std::nullopt;
  if (!why) return run;
  run.strained = run.met();
  run.violations.push_back(*why);
  return run;
}

/// Returns the state known from the search, shown in place of a path that was stopped before its end.
NamedState known_state(const Run& run) {
  const model::State& state = run.known->state;
  return {"target", to_string(run.known->model), model::mean_theta(run.design.structure, state), state,
          hinge_gaps(run.design.structure, state)};
}

/// Adds the states in which the model holds what was found, if it has any.
Run with_model_states(Run run, const RunOptions& options) {
  if (run.design.structure.assembly()) return with_closed_path(std::move(run), options);
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
  model::append(run.design.notes, run.plan.why);
  model::append(run.notes, run.plan.why);
  return run;
}

/// Runs all models and checks on what was found. @param goal null for a design
Run run_found(SearchResult found, const Goal* goal, const RunOptions& options) {
  const double searched_theta = found.theta;
  Run run = held(std::move(found), goal, options);
  if (goal) run = settled(std::move(run), *goal, options);
  // The answer of `export` to the search does not count if the equilibrium of soft hinges ends elsewhere.
  if (run.print && run.print->is_accepted && written_design(run).theta != searched_theta) run.print.reset();
  const bool simulates = options.verify && !options.stop.stop_requested();
  if (simulates && run.closed_path) run = with_pieces(std::move(run), options);
  const std::optional<PhysicsTask> task = simulates ? physics_task(run) : std::nullopt;

  ParallelChecks parallel_checks(run, goal, options);
  std::future<void> beside = work_beside(parallel_checks, options.threads);
  Stopwatch watch;
  std::optional<Verification> simulated;
  if (task) simulated = verify(run, *task, options);
  const double seconds = watch.lap();
  options.progress(run.goal ? "prints, contact" : "contact", -1);
  parallel_checks.work();
  beside.get();

  run = with_check_results(std::move(run), parallel_checks.check_results());
  if (task) run.timings.verify = seconds;
  if (simulated) run = with_physics(std::move(run), goal, std::move(*simulated), *task, options);
  run = with_strain(std::move(run));
  if (run.goal && run.equilibrium && run.equilibrium->reached())
    run.folding = folding_of(run.equilibrium->path, run.equilibrium->drive, run.design);
  run.stopped = options.stop.stop_requested();
  if (goal && !run.compensation && run.plan.model != Model::equilibrium)
    model::append(exact_frames(run), run.states);
  return run;
}

}  // namespace

Run held(SearchResult found, const Goal* goal, const RunOptions& options) {
  Run run;
  run.seed = options.seed;
  Stopwatch watch;
  static_cast<SearchResult&>(run) = planned(std::move(found), options.brief);
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
  if (has_elastic_hinges(run)) run = compensate_for_elasticity(std::move(run), goal, options);
  if (const auto why = describe_drive_stop(run)) run.violations.push_back(*why);
  run.timings.compensation = watch.lap();
  return run;
}

Run run_goal(const Goal& goal, const RunOptions& options) {
  Stopwatch watch;
  Searched searched = search_printable(goal, options);
  const double seconds = watch.lap();
  Run run = run_found(std::move(searched.found), searched.goal.get(), options);
  run.timings.optimise = seconds;
  if (const std::string remedy = find_remedy(goal, run, options); !remedy.empty())
    run.violations.front() += ". " + remedy;
  return run;
}

Run run_design(Design design, Model model, RunOptions options) {
  const bool is_sheet = !design.structure.assembly();
  options.verify &= model == Model::bullet;
  options.certify &= is_sheet;
  SearchResult found;
  found.theta = design.theta;
  found.model = plan_model(design, model);
  if (model == Model::exact && is_sheet) found.plan.exact = exact_motion(design.structure);
  if (model == Model::exact && is_sheet && !found.plan.exact)
    throw InvalidInput(found.plan.exact.why +
                       ". Give --model equilibrium or rigid_body, which need no exact family");
  found.design = std::move(design);
  return run_found(std::move(found), nullptr, options);
}

}  // namespace kinetix::app
