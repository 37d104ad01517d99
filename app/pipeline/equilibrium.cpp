#include "app/pipeline/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/hinge_loads.hpp"
#include "model/base/append.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/exact_theta.hpp"
#include "model/elastic/path/turning_points.hpp"

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
                          ? "the design's hinges are rotary; for this model they are taken as elastic: "
                          : "elastic hinges: ";
  const std::string others =
      design.hinge_overrides.empty() ? "" : fmt::format("; {} of their own", design.hinge_overrides.size());
  const std::string play = e.play_mm > 0 ? fmt::format(", play {:g} mm", e.play_mm) : "";
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
  return drive.as_far_as(path.steps.back().drive);
}

/// Adds the closed form's state of the same drive, and how far the equilibrium is from it.
void add_exact(const Found& found, ElasticState& out) {
  Equilibrium& equilibrium = out.equilibrium;
  const model::Lattice& sheet = found.design.structure;
  try {
    const double theta =
        exact_theta({sheet, reached_drive(equilibrium.drive, equilibrium.path), found.plan.exact},
                    equilibrium.elasticity);
    model::State exact = found.plan.exact.at(theta);
    equilibrium.from_exact = aligned_distance(sheet, equilibrium.path.state, exact);
    equilibrium.turned_off = turn_distance(sheet, equilibrium.path.state, exact);
    const model::HingeGaps gaps = hinge_gaps(sheet, exact);
    out.states.push_back({"target", to_string(Model::exact), theta, std::move(exact), gaps});
    out.fidelity.push_back(exact_fidelity(found.plan.exact, sheet, theta));
  } catch (const InvalidInput& e) {
    out.why.push_back("no closed form to compare with: " + e.reason());
  }
}

Fidelity fidelity_of(const Equilibrium& equilibrium, double seconds) {
  const auto& distance = equilibrium.from_exact;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {to_string(Model::equilibrium), seconds, distance ? distance->rms : nan,
          distance ? to_string(Model::exact) : "no closed form"};
}

}  // namespace

model::EquilibriumPathOptions path_of_run(bool planar) {
  model::EquilibriumPathOptions options;
  options.planar = planar;
  options.longest_step = longest_step;
  return options;
}

ElasticState follow_drive(const Found& found, const model::LinkageDrive& drive,
                          const model::Elasticity& elasticity, int frames, const RunOptions& options,
                          std::shared_ptr<const model::ConvexBodies> bodies) {
  ElasticState out;
  if (!bodies)
    out.why = {stiffness_sentence(found.design, elasticity),
               "contact: each half wall is a plate cut along its hinge axis; pins, knuckles and blocks of "
               "hinges are "
               "left out, and edges that meet head on may be in each other by up to half the thickness"};
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
  follow_fall(driven, elasticity, path_options, turns);
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
  if (!exact || path.off_closed_form || !drive.tells_fold()) return turned;
  try {
    return exact_theta({sheet, reached_drive(drive, path), exact}, elasticity);
  } catch (const InvalidInput&) {
    return turned;
  }
}

}  // namespace kinetix::app
