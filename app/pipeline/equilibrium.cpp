#include "app/pipeline/equilibrium.hpp"

#include <fmt/format.h>

#include "app/pipeline/closed_form.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/physics.hpp"
#include "model/base/algorithms.hpp"
#include "model/closure/drive_theta.hpp"
#include "optim/elastic/compensation.hpp"

namespace kinetix::app {
namespace {

// Rad of theta: as fine as the frames of a sheet that folds by 40 deg. The step does not depend on how far a drive
// goes, because events on the path must not depend on that.
constexpr double longest_step = 0.06;
constexpr double steps_per_frame = 2;  // states kept per frame shown, so that frames are nearly evenly spaced

/// Recorder of a motion: keeps states at even distances of theta, closer than the final frames, and the last state.
class FrameKeeper {
 public:
  FrameKeeper(double goal, int frames) : spacing_(std::abs(goal) / (steps_per_frame * frames)) {}

  void see(double theta, const model::State& state) {
    latest_ = {"frame", to_string(Model::equilibrium), theta, state, {}};
    if (kept_.empty() || !(std::abs(theta - kept_.back().theta) < spacing_)) kept_.push_back(latest_);
  }

  /// Returns the states nearest to `count` even distances up to `last`, the end of the motion.
  std::vector<NamedState> even(double last, int count) const {
    std::vector<NamedState> frames;
    for (int k = 0; k < count; ++k) {
      const NamedState& frame = k + 1 < count ? nearest(last * k / (count - 1)) : latest_;
      if (frames.empty() || frame.theta != frames.back().theta) frames.push_back(frame);
    }
    return frames;
  }

 private:
  const NamedState& nearest(double theta) const {
    return *std::min_element(kept_.begin(), kept_.end(), [&](const NamedState& a, const NamedState& b) {
      return std::abs(a.theta - theta) < std::abs(b.theta - theta);
    });
  }

  double spacing_;
  std::vector<NamedState> kept_;
  NamedState latest_;
};

std::string stiffness_sentence(const Design& design, const model::Elasticity& e) {
  const char* start = design.hinge.model == HingeSection::Model::rotary
                          ? "the design has revolute joints; this model assumes elastic hinges: "
                          : "elastic hinges: ";
  const std::string others =
      design.hinge_overrides.empty() ? "" : fmt::format("; {} hinges differ", design.hinge_overrides.size());
  const std::string play = e.play_mm > 0 ? fmt::format(", clearance {:g} mm per side", e.play_mm) : "";
  const std::string end =
      fmt::format(", reach_mm {:g}, k_contact {:g} N/mm{}{}", e.reach_mm, e.k_contact, play, others);
  if (const auto k = framed_stiffness(design.hinge))
    return fmt::format(
        "{}{:g} N/mm along the wall, {:g} across it, {:g} along the axis, {:g} N mm/rad about it{}", start,
        k->axial, k->shear, k->along, k->turn, end);
  return fmt::format("{}k_point {:g} N/mm, k_turn {:g} N mm/rad{}", start,
                     design.hinge_overrides.empty() ? e.k_point : design.hinge.k_point, e.k_turn, end);
}

/// Returns the drive up to the end of the path.
model::LinkageDrive reached_drive(const model::LinkageDrive& drive, const model::EquilibriumPath& path) {
  return drive.limited_to(path.steps.back().drive);
}

/// Adds the closed form's state of the same drive, and how far the equilibrium is from it.
void add_exact(const SearchResult& found, ElasticState& out) {
  Equilibrium& equilibrium = out.equilibrium;
  const model::Lattice& sheet = found.design.structure;
  try {
    const double theta =
        exact_theta({sheet, reached_drive(equilibrium.drive, equilibrium.path), found.plan.exact},
                    equilibrium.elasticity);
    model::State exact = found.plan.exact.at(theta);
    equilibrium.from_exact = aligned_distance(sheet, equilibrium.path.state, exact);
    equilibrium.turn_difference = turn_distance(sheet, equilibrium.path.state, exact);
    const model::HingeGaps gaps = hinge_gaps(sheet, exact);
    out.states.push_back({"target", to_string(Model::exact), theta, std::move(exact), gaps});
    out.fidelity.push_back(exact_fidelity(found.plan.exact, sheet, theta));
  } catch (const InvalidInput& e) {
    out.why.push_back("no analytic motion to compare with: " + e.reason());
  }
}

Fidelity fidelity_of(const Equilibrium& equilibrium, double seconds) {
  const auto& distance = equilibrium.from_exact;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {to_string(Model::equilibrium), seconds, distance ? distance->rms : nan,
          distance ? to_string(Model::exact) : "no analytic motion"};
}

}  // namespace

model::EquilibriumPathOptions path_of_run(bool planar) {
  model::EquilibriumPathOptions options;
  options.planar = planar;
  options.longest_step = longest_step;
  return options;
}

ElasticState follow_drive(const SearchResult& found, const model::LinkageDrive& drive,
                          const model::Elasticity& elasticity, int frames, const RunOptions& options,
                          std::shared_ptr<const model::ConvexBodies> bodies) {
  ElasticState out;
  if (!bodies)
    out.why = {stiffness_sentence(found.design, elasticity),
               "contact: each half wall is a plate cut along its hinge axis; pins, knuckles and blocks of "
               "hinges are ignored, and edges that meet head on may overlap by up to half the thickness"};
  const model::Lattice& sheet = found.design.structure;
  const double goal = drive.theta();
  model::EquilibriumPathOptions path_options = path_of_run(found.plan.planar);
  path_options.side = found.design.side;
  path_options.stop = options.stop;
  path_options.bodies = std::move(bodies);
  FrameKeeper keeper(goal, frames);
  model::EnergyTurns turns(drive);
  model::LoadTurns load_turns;
  const auto see = [&](const model::EquilibriumStep& step, const model::State& state) {
    keeper.see(step.theta, state);
    turns.see(step, state);
    load_turns.see(step, state);
    options.progress("equilibrium path", goal == 0 ? 1 : step.theta / goal);
  };
  const auto start = std::chrono::steady_clock::now();
  const model::DrivenLinkage driven{sheet, drive, found.plan.exact};
  model::EquilibriumPath path = trace_equilibrium(driven, elasticity, path_options, see);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  add_limit_points(path,
                   located_limit_points(driven.linkage, elasticity, drive, path_options, load_turns, path));
  const double last = path.theta;
  out.theta = reached_theta(sheet, found.plan.exact, drive, path, elasticity);
  out.states.push_back({"target", to_string(Model::equilibrium), out.theta, path.state, path.gaps});
  follow_descent(driven, elasticity, path_options, turns);
  model::StableStates stable = stable_states(sheet, elasticity, {turns}, {.path = path_options});
  out.equilibrium = Equilibrium{elasticity, drive, std::move(path), std::move(stable), {}};
  if (found.plan.exact) add_exact(found, out);
  out.fidelity.push_back(fidelity_of(out.equilibrium, seconds));
  for (NamedState& frame : keeper.even(last, frames)) {
    frame.gaps = hinge_gaps(sheet, frame.poses);
    out.states.push_back(std::move(frame));
  }
  return out;
}

Run with_states(Run run, ElasticState state) {
  run.theta = state.theta;
  run.equilibrium = std::move(state.equilibrium);
  model::append(std::move(state.states), run.states);
  model::append(std::move(state.fidelity), run.fidelity);
  model::append(std::move(state.why), run.plan.why);
  return run;
}

double reached_theta(const model::Lattice& sheet, const model::ExactMotion& exact,
                     const model::LinkageDrive& drive, const model::EquilibriumPath& path,
                     const model::Elasticity& elasticity) {
  if (sheet.assembly()) return reached_drive(drive, path).theta();
  const double turned = model::mean_theta(sheet, path.state);
  if (!exact || path.off_closed_form || !drive.determines_fold()) return turned;
  try {
    return exact_theta({sheet, reached_drive(drive, path), exact}, elasticity);
  } catch (const InvalidInput&) {
    return turned;
  }
}

namespace {

// Ratio to the tolerance: an equilibrium this near its goal is not improved further.
constexpr double near_enough = 0.05;
// Cell edges: limit within which the end of a path from flat is the equilibrium of the search. Residual forces of
// both separate them by 2e-4 with soft hinges. Any other state this near would serve as well.
constexpr double same_state = 1e-3;

// Ratio of stiffnesses: springs this much stiffer than their hinges rest at 1.25 times the turn that they hold.
constexpr double spring_over_hinge = 4;

/// Returns the largest turning stiffness of a hinge, N mm/rad.
double stiffest_turn(const model::Elasticity& elasticity, int hinges) {
  double most = 0;
  for (int h = 0; h < hinges; ++h) most = std::max(most, elasticity.of(static_cast<std::size_t>(h)).k_turn);
  return most;
}

/// Returns the drive for design.yaml; empty if the file need not name it.
std::optional<model::Drive> springs_to(const SearchResult& found, double theta) {
  if (!found.goal_drive) return std::nullopt;
  model::ShapeMemory springs = *found.goal_drive;
  springs.angle = 2 * theta;
  return springs;
}

double rms_mm(const Goal::Observed& observed) {
  return model::ObservedPoints(observed.points, true).rms_mm();
}

optim::ElasticGoal goal_of(const SearchResult& found, const Goal& goal) {
  optim::ElasticGoal out;
  out.observe = [&found, &goal](const model::Lattice& sheet, const model::State& state) {
    const auto observed = goal.observe(found, sheet, state);
    return observed ? observed->points : std::vector<model::ObservedPoint>{};
  };
  out.drive = [&found](const model::Lattice& sheet, double theta) { return goal_drive(found, sheet, theta); };
  return out;
}

/// Returns the bounds of the compensation. For shape-memory drives theta is the springs' rest angle, beyond the
/// reached fold, so the general bounds apply to it.
optim::CompensationOptions bounded(const TurnBounds& bounds, bool by_springs) {
  optim::CompensationOptions options;
  options.ties = bounds.ties;
  options.tilt = bounds.tilt;
  if (by_springs) return options;
  options.min_theta = bounds.theta.lower;
  options.max_theta = bounds.theta.upper;
  return options;
}

model::EquilibriumPath path_to(const SearchResult& found, const model::Lattice& sheet, double theta,
                               const model::Elasticity& elasticity, const std::stop_token& stop) {
  model::EquilibriumPathOptions options;
  options.planar = found.plan.planar;
  options.stop = stop;
  return trace_equilibrium({sheet, goal_drive(found, sheet, theta), exact_motion(sheet)}, elasticity,
                           options);
}

/// Compensates the exact design. @param path of that design, which reached its goal
optim::Compensation compensate_goal(const SearchResult& found, const Goal& goal,
                                    const model::EquilibriumPath& path, const model::Elasticity& elasticity,
                                    double tolerance_mm, const std::stop_token& stop) {
  optim::CompensationOptions search = bounded(found.bounds, found.goal_drive.has_value());
  search.enough_mm = near_enough * tolerance_mm;
  search.stop = stop;
  return compensate({found.design.structure, found.theta, path.state}, elasticity, goal_of(found, goal),
                    search);
}

/// Whether a state misses its goal by more than the tolerance of its points. That is the effect of hinges too soft
/// for their drive, which springs cure. They cure no other violation.
bool is_far_off(const Run& run, const Goal& goal, const model::State& state) {
  const auto observed = goal.observe(run, run.design.structure, state);
  return !observed || rms_mm(*observed) > observed->tolerance_mm;
}

/// Replaces the exact design by the compensated one, with its path from flat. The plan keeps the sentences that the
/// search added. The others described the exact design, whose states come from the closed form.
Run showing(Run run, const optim::ElasticFit& found, const model::Elasticity& elasticity,
            const RunOptions& options) {
  const Plan exact = std::move(run.plan);
  run.design.structure = found.sheet;
  run.theta = found.theta;
  run.plan = make_plan(run.design.structure, Model::equilibrium);
  run.plan.why.insert(run.plan.why.end(), exact.why.begin() + static_cast<std::ptrdiff_t>(exact.decided),
                      exact.why.end());
  run.states.clear();
  run.fidelity.clear();
  run.design.drive = springs_to(run, run.theta);
  const model::LinkageDrive drive = goal_drive(run, run.design.structure, run.theta);
  ElasticState state = follow_drive(run, drive, elasticity, motion_states, options);
  const model::State exact_shown = run.to_shown ? moved(run.own, *run.to_shown) : run.own;
  if (run.is_aligned)
    for (NamedState& one : state.states) one.poses = aligned(one.poses, exact_shown);
  return with_states(std::move(run), std::move(state));
}

std::string advise_springs(const model::Elasticity& elasticity, int hinges) {
  return fmt::format(
      "plates and single hinges let soft hinges lean or buckle sooner than they fold them: try "
      "`drive: {{kind: shape_memory, k_turn: {:.3g}}}`, springs in all hinges, {:g} times as stiff as "
      "these, or "
      "stiffer hinges",
      spring_over_hinge * stiffest_turn(elasticity, hinges), spring_over_hinge);
}

CompensationResult result_of(const Goal::Observed& exact, const optim::Compensation& found) {
  return {.exact_mm = rms_mm(exact),
          .before_mm = found.before.rms_mm,
          .after_mm = found.after.rms_mm,
          .tolerance_mm = exact.tolerance_mm,
          .largest_change = found.largest_change,
          .theta_change = found.after.theta - found.before.theta,
          .rounds = found.rounds,
          .why = found.why};
}

Run missed(Run run, const std::string& why) {
  run.compensation->why = why;
  run.violations.push_back("equilibrium of the elastic hinges: " + why);
  return run;
}

/// Measures the equilibrium at the end of the path against the goal. @pre the drive reached its goal
Run measured(Run run, const Goal& goal, const RunOptions& options) {
  const Equilibrium& equilibrium = *run.equilibrium;
  const model::State& end = equilibrium.path.state;
  if (auto measure = goal.measure(run, StateOf::equilibrium, end, options)) {
    run.violations = measure->violations;
    run.by_equilibrium = std::move(measure);
  }
  if (!run.met() && !run.goal_drive && is_far_off(run, goal, end))
    run.violations.push_back(advise_springs(equilibrium.elasticity, run.design.structure.hinges()));
  return run;
}

/// Judges the end of the path from flat if it differs from the state of the search, which ignores contact.
/// @param away distance from that state, cell edges
Run elsewhere(Run run, const Goal& goal, double away) {
  const std::string where = fmt::format(
      "the path from flat ends in another equilibrium than the one near the goal, {:.3g} mm from it",
      away * run.design.structure.size().edge_mm);
  if (const auto observed = goal.observe(run, run.design.structure, run.equilibrium->path.state))
    run.compensation->after_mm = rms_mm(*observed);
  if (!run.met()) return missed(std::move(run), where);
  run.compensation->why = where + ", and within tolerance as well";
  return run;
}

}  // namespace

model::LinkageDrive goal_drive(const SearchResult& found, const model::Lattice& sheet, double theta) {
  const auto springs = springs_to(found, theta);
  return springs ? drive_on(sheet, *springs) : drive_to(sheet, theta);
}

bool has_elastic_hinges(const SearchResult& found) {
  return found.goal && found.design.hinge.model == HingeSection::Model::elastic &&
         found.plan.model != Model::equilibrium;
}

CompensatedPath trace_compensated_path(const SearchResult& found, const Goal& goal,
                                       const std::stop_token& stop) {
  const model::Elasticity elasticity = elasticity_of(found.design);
  CompensatedPath out{found.design.structure, found.theta,
                      goal_drive(found, found.design.structure, found.theta),
                      path_to(found, found.design.structure, found.theta, elasticity, stop)};
  const auto exact = goal.observe(found, found.design.structure, found.own);
  if (!exact || out.path.stop != model::EquilibriumPath::Stop::reached) return out;
  const optim::ElasticFit after =
      compensate_goal(found, goal, out.path, elasticity, exact->tolerance_mm, stop).after;
  const model::LinkageDrive drive = goal_drive(found, after.sheet, after.theta);
  model::EquilibriumPathOptions options = path_of_run(found.plan.planar);
  options.stop = stop;
  return {after.sheet, after.theta, drive,
          trace_equilibrium({after.sheet, drive, exact_motion(after.sheet)}, elasticity, options)};
}

Run compensate_for_elasticity(Run run, const Goal& goal, const RunOptions& options) {
  const auto exact = goal.observe(run, run.design.structure, run.own);
  if (!exact) return run;
  options.progress("compensation for elastic hinges", 0);
  const model::Elasticity elasticity = elasticity_of(run.design);
  run.compensation = CompensationResult{.exact_mm = rms_mm(*exact),
                                        .before_mm = std::nan(""),
                                        .after_mm = std::nan(""),
                                        .tolerance_mm = exact->tolerance_mm,
                                        .why = ""};
  const model::EquilibriumPath path = path_to(run, run.design.structure, run.theta, elasticity, options.stop);
  if (path.stop != model::EquilibriumPath::Stop::reached) return missed(std::move(run), path.why);
  const optim::Compensation found =
      compensate_goal(run, goal, path, elasticity, exact->tolerance_mm, options.stop);
  run.compensation = result_of(*exact, found);
  run = showing(std::move(run), found.after, elasticity, options);
  if (!run.equilibrium->reached()) return missed(std::move(run), std::string(run.equilibrium->path.why));
  run = measured(std::move(run), goal, options);
  const double away =
      aligned_distance(run.design.structure, run.equilibrium->path.state, found.after.state).max;
  return away <= same_state ? run : elsewhere(std::move(run), goal, away);
}

}  // namespace kinetix::app
