#include "app/assembly/assembly_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "app/run/stopwatch.hpp"
#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/linkage/make_drive.hpp"
#include "sim/pull_run.hpp"

namespace kinetix::app {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double most_overlap_mm = 0.1;  // mm: by which pieces may stick out of their bodies
constexpr double stiff = 1e8;  // joint_stiffness of what closes exactly, as of exact families of sheets
constexpr std::array step_factors = {10.0, 4.0,
                                     1.0};  // times the usual step, tried one after the other as of sheets

/// The hinge that is turned, and the direction that the first motion gives it.
int driven_hinge(const AssemblyFile& file, const model::FirstMotion& first) {
  if (file.driven) return *file.driven;
  if (first.fastest < 0)
    throw InvalidInput(
        "nothing moves: no hinge turns in a first motion; `drive: {hinge: NAME, ...}` says which to turn");
  return first.fastest;
}

int sense_of(const AssemblyRun& run) {
  return run.linkage.bodies[run.linkage.hinges[run.driven].lower].sense;
}

double turn_of(const AssemblyRun& run) { return model::turn_at_theta(sense_of(run), run.theta); }

void add_state(AssemblyRun& run, const std::string& name, Model model, double theta,
               const model::State& state) {
  run.states.push_back({name, to_string(model), theta, state, hinge_gaps(run.linkage, state)});
}

void close(AssemblyRun& run, const model::FirstMotion& first, const RunOptions& options) {
  Stopwatch watch;
  model::AssemblyMotionOptions way;
  way.stop = [&] { return options.stop.stop_requested(); };
  run.motion = follow_turn(run.linkage, first, run.driven, turn_of(run), way);
  run.closure_s = watch.lap();
}

void follow_pull(AssemblyRun& run, const RunOptions& options) {
  Stopwatch watch;
  model::DeploymentOptions how;
  how.stop = [&] { return options.stop.stop_requested(); };
  run.deployment = deploy(run.linkage, *run.file.pull(), how);
  run.motion.states = run.deployment->states;
  run.motion.gap = run.deployment->gap;
  run.motion.axis_gap = run.deployment->axis_gap;
  run.motion.reached = run.deployment->reached;
  for (const model::State& state : run.motion.states)
    run.motion.turns.push_back(2 * mean_half_turn(run.linkage, state));
  run.theta = run.motion.turns.back() / 2;
  run.closure_s = watch.lap();
}

void add_motion(AssemblyRun& run) {
  for (std::size_t k = 0; k < run.motion.states.size(); ++k)
    add_state(run, "frame", Model::exact, run.theta_of(k), run.motion.states[k]);
}

/// Those of a run before, where they fit.
void find_pieces(AssemblyRun& run, const RunOptions& options) {
  if (!run.pieces || !run.pieces->fit(run.file.assembly))
    run.pieces = std::make_shared<const BodyPieces>(pieces_of(run.file.assembly, options.threads));
}

/// Those that press on each other in equilibrium.
std::shared_ptr<const model::ConvexBodies> pressing_bodies(AssemblyRun& run, const RunOptions& options) {
  find_pieces(run, options);
  const auto alone = options.engine ? std::unique_lock(*options.engine) : std::unique_lock<std::mutex>();
  return std::make_shared<const model::ConvexBodies>(
      convex_bodies(*run.pieces, run.file.assembly, run.linkage));
}

void add_equilibrium(AssemblyRun& run, const RunOptions& options) {
  Stopwatch watch;
  model::EquilibriumPathOptions path;
  path.planar = false;
  path.stop = options.stop;
  path.bodies = pressing_bodies(run, options);
  run.equilibrium =
      trace_equilibrium({run.linkage, run.drive(), {}}, elasticity_of(run.file.assembly), path,
                        [&](const model::EquilibriumStep& step, const model::State&) {
                          options.progress("equilibrium path", run.theta == 0 ? 1 : step.theta / run.theta);
                        });
  run.equilibrium_s = watch.lap();
  add_state(run, "target", Model::equilibrium, run.equilibrium->theta, run.equilibrium->state);
}

sim::PhysicsOptions physics_of(const AssemblyRun& run, double factor) {
  sim::PhysicsOptions options;
  options.step_s *= factor;
  options.overlap_limit = std::max(options.overlap_limit, most_overlap_mm / run.file.assembly.edge_mm);
  options.joint_stiffness = run.motion.reached ? stiff : options.joint_stiffness;
  double reach = run.file.assembly.edge_mm;
  for (const model::AssemblyHinge& h : run.file.assembly.hinges) reach = std::min(reach, h.reach_mm);
  options.reach = reach / run.file.assembly.edge_mm;
  options.planar = run.deployment && all_vertical(run.linkage);
  return options;
}

sim::PhysicsResult run_physics(const AssemblyRun& run, const sim::PhysicsOptions& options,
                               const sim::ContactParts& parts, const sim::PhysicsObserver& observer) {
  if (run.deployment) return run_pull(run.linkage, *run.file.pull(), options, parts, observer);
  return run_with_parts(run.linkage, run.drive(), options, parts, observer);
}

/// Folds it by the engine, in coarse steps where these already settle in the closed state.
void verify_assembly(AssemblyRun& run, const RunOptions& options) {
  find_pieces(run, options);
  const sim::ContactParts parts = contact_parts(*run.pieces, run.file.assembly);
  Verification v;
  for (const double factor : step_factors) {
    v = {};
    v.options = physics_of(run, factor);
    sim::PhysicsObserver observer;
    observer.stop = options.stop;
    observer.progress = [&](double done) { options.progress("physics run", done); };
    v.physics = run_physics(run, v.options, parts, observer);
    v.compared = run.motion.reached;
    const bool settled = v.physics.status == sim::PhysicsResult::Status::settled;
    v.distance = settled && v.compared
                     ? aligned_distance(run.linkage, v.physics.state, run.motion.states.back())
                     : model::StateDistance{not_a_number, not_a_number};
    v.agrees = settled && (!v.compared || v.distance.rms <= GoalSettings::usual_verify);
    if (v.agrees || options.stop.stop_requested()) break;
  }
  add_state(run, "target", Model::bullet, run.theta, v.physics.state);
  run.verification = std::move(v);
}

/// Turns the hinge of the drive along closed states.
void turn_hinge(AssemblyRun& run, std::optional<double> theta, const RunOptions& options) {
  const model::FirstMotion first = first_motion(run.linkage);
  run.driven = driven_hinge(run.file, first);
  run.theta = theta.value_or(model::theta_at_turn(sense_of(run), run.file.angle));
  close(run, first, options);
}

void refuse_pulled(const AssemblyRun& run, std::optional<double> theta) {
  const auto& hinges = run.file.assembly.hinges;
  const auto ball = std::find_if(hinges.begin(), hinges.end(), [](const auto& h) { return h.ball; });
  if (theta && run.file.is_pulled())
    throw InvalidInput("--theta-deg turns a hinge, and here bodies are pulled", {"", 0, 0, "drive"});
  if (run.model != Model::equilibrium) return;
  if (run.file.is_pulled())
    throw InvalidInput("the model equilibrium turns one hinge: give `drive: {hinge: NAME, angle_deg: ...}`",
                       {"", 0, 0, "drive"});
  if (ball != hinges.end())
    throw InvalidInput(
        "the model equilibrium knows hinges with an axis only, and `" + ball->name + "` is a ball",
        {"", 0, 0, "structure.hinges"});
}

}  // namespace

double AssemblyRun::theta_of(std::size_t k) const {
  return deployment ? motion.turns[k] / 2 : model::theta_at_turn(sense_of(*this), motion.turns[k]);
}

model::LinkageDrive AssemblyRun::drive() const {
  return model::turned_hinge(driven, sense_of(*this), turn_of(*this));
}

model::Elasticity elasticity_of(const model::Assembly& assembly) {
  model::Elasticity whole;
  for (const model::AssemblyHinge& h : assembly.hinges) {
    model::HingeStiffness k = h.k;
    whole.each.push_back(elasticity_of(k, h.reach_mm));
  }
  whole.k_point = whole.each.front().k_point;
  for (const model::Elasticity& e : whole.each) whole.k_point = std::max(whole.k_point, e.k_point);
  whole.k_contact = 10 * whole.k_point;
  return whole;
}

AssemblyRun run_assembly(AssemblyFile file, Model model, std::optional<double> theta,
                         const RunOptions& options, std::shared_ptr<const BodyPieces> pieces) {
  AssemblyRun run;
  run.pieces = std::move(pieces);
  run.file = std::move(file);
  run.model = model;
  run.linkage = linkage_of(run.file.assembly);
  refuse_pulled(run, theta);
  if (run.file.is_pulled())
    follow_pull(run, options);
  else
    turn_hinge(run, theta, options);
  if (model == Model::equilibrium)
    add_equilibrium(run, options);
  else if (run.motion.reached || model == Model::exact)
    add_state(run, "target", Model::exact, run.theta_of(run.motion.states.size() - 1),
              run.motion.states.back());
  if (model == Model::bullet) verify_assembly(run, options);
  add_motion(run);
  return run;
}

}  // namespace kinetix::app
