#include "app/pipeline/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "app/pipeline/design_drive.hpp"
#include "app/pipeline/exact_state.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/exact_theta.hpp"
#include "model/elastic/path/turning_points.hpp"

namespace kinetix::app {
namespace {

// Rad of theta: as fine as the states that a run shows of a sheet that folds by 40 deg, and the same however far a drive goes, since
// what happens on the way must not depend on that.
constexpr double longest_step = 0.06;
constexpr double steps_per_frame = 2;  // states kept for each frame shown, so that frames lie nearly evenly

/// Keeps states of a motion at even distances of theta, closer than the frames that are wanted in the end, and its last one.
class FrameKeeper {
 public:
  FrameKeeper(double goal, int frames) : spacing_(std::abs(goal) / (steps_per_frame * frames)) {}

  void see(double theta, const model::State& state) {
    latest_ = {"frame", to_string(Model::equilibrium), theta, state, {}};
    if (kept_.empty() || !(std::abs(theta - kept_.back().theta) < spacing_)) kept_.push_back(latest_);
  }

  /// Those nearest to `count` even distances up to `last`, where the motion ends.
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

std::string stiffness_sentence(const Run& run, const model::Elasticity& e) {
  const char* start = run.design.hinge.model == HingeSection::Model::rotary
                          ? "the design's hinges are rotary; for this model they are taken as elastic: "
                          : "elastic hinges: ";
  const std::string others =
      run.design.own_hinges.empty() ? "" : fmt::format("; {} of their own", run.design.own_hinges.size());
  const std::string play = e.play_mm > 0 ? fmt::format(", play {:g} mm", e.play_mm) : "";
  const std::string end =
      fmt::format(", reach_mm {:g}, k_contact {:g} N/mm{}{}", e.reach_mm, e.k_contact, play, others);
  if (const auto k = framed_stiffness(run.design.hinge))
    return fmt::format(
        "{}{:g} N/mm along the wall, {:g} across it, {:g} along the axis, {:g} N mm/rad about it{}", start,
        k->axial, k->shear, k->along, k->turn, end);
  return fmt::format("{}k_point {:g} N/mm, k_turn {:g} N mm/rad{}", start,
                     run.design.own_hinges.empty() ? e.k_point : run.design.hinge.k_point, e.k_turn, end);
}

/// The drive, as far as the path came.
model::LinkageDrive reached_drive(model::LinkageDrive drive, const model::EquilibriumPath& path) {
  double& coordinate = drive.pulls_cord()                                ? drive.shorten_mm
                       : drive.kind == model::LinkageDrive::Kind::plates ? drive.compression
                                                                         : drive.angle;
  coordinate = path.steps.back().drive;
  return drive;
}

/// The closed form of the same drive, and how far the equilibrium is from it.
void add_exact(Run& run) {
  Equilibrium& equilibrium = *run.equilibrium;
  try {
    const double theta = exact_theta(
        {run.design.structure, reached_drive(equilibrium.drive, equilibrium.path), run.plan.exact},
        equilibrium.elasticity);
    model::State exact = run.plan.exact.at(theta);
    equilibrium.from_exact = aligned_distance(run.design.structure, equilibrium.path.state, exact);
    equilibrium.turned_off = turn_distance(run.design.structure, equilibrium.path.state, exact);
    const model::HingeGaps gaps = hinge_gaps(run.design.structure, exact);
    run.states.push_back({"target", to_string(Model::exact), theta, std::move(exact), gaps});
    run.fidelity.push_back(exact_fidelity(run.plan.exact, run.design.structure, theta));
  } catch (const InvalidInput& e) {
    run.plan.why.push_back("no closed form to compare with: " + e.reason());
  }
}

void add_frames(Run& run, const std::vector<NamedState>& frames) {
  for (NamedState frame : frames) {
    frame.gaps = hinge_gaps(run.design.structure, frame.poses);
    run.states.push_back(std::move(frame));
  }
}

void add_fidelity(Run& run, double seconds) {
  const auto& distance = run.equilibrium->from_exact;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  run.fidelity.push_back({to_string(Model::equilibrium), seconds, distance ? distance->rms : nan,
                          distance ? to_string(Model::exact) : "no closed form"});
}

}  // namespace

model::EquilibriumPathOptions path_of_run(bool planar) {
  model::EquilibriumPathOptions options;
  options.planar = planar;
  options.longest_step = longest_step;
  return options;
}

void add_equilibrium(Run& run, const model::LinkageDrive& drive, const model::Elasticity& elasticity,
                     int frames, const RunOptions& run_options) {
  run.plan.why.push_back(stiffness_sentence(run, elasticity));
  run.plan.why.emplace_back(
      "contact: each half wall is a plate cut along its hinge axis; pins, knuckles and blocks of hinges are "
      "left out, and edges that meet head on may be in each other by up to half the thickness");
  const double goal = drive.theta();
  model::EquilibriumPathOptions path_options = path_of_run(run.plan.planar);
  path_options.side = run.design.side;
  path_options.stop = run_options.stop;
  FrameKeeper keeper(goal, frames);
  model::EnergyTurns turns(drive);
  model::LoadTurns load_turns;
  const auto see = [&](const model::EquilibriumStep& step, const model::State& state) {
    keeper.see(step.theta, state);
    turns.see(step, state);
    load_turns.see(step, state);
    run_options.progress("equilibrium path", goal == 0 ? 1 : step.theta / goal);
  };
  const auto start = std::chrono::steady_clock::now();
  const model::DrivenLinkage driven{run.design.structure, drive, run.plan.exact};
  model::EquilibriumPath path = trace_equilibrium(driven, elasticity, path_options, see);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  add_limit_points(path,
                   located_limit_points(driven.linkage, elasticity, drive, path_options, load_turns, path));
  const double last = path.theta;
  run.theta = reached_theta(run.design.structure, run.plan.exact, drive, path, elasticity);
  run.states.push_back({"target", to_string(Model::equilibrium), run.theta, path.state, path.gaps});
  follow_fall(driven, elasticity, path_options, turns);
  model::StableStates stable =
      stable_states(run.design.structure, elasticity, {turns}, {.path = path_options});
  run.equilibrium = Equilibrium{elasticity, drive, std::move(path), std::move(stable), {}};
  if (run.plan.exact) add_exact(run);
  add_fidelity(run, seconds);
  add_frames(run, keeper.even(last, frames));
}

double reached_theta(const model::Sheet& sheet, const model::ExactMotion& exact,
                     const model::LinkageDrive& drive, const model::EquilibriumPath& path,
                     const model::Elasticity& elasticity) {
  const double turned = model::mean_theta(sheet, path.state);
  if (!exact || path.off_closed_form || drive.has_own_theta()) return turned;
  try {
    return exact_theta({sheet, reached_drive(drive, path), exact}, elasticity);
  } catch (const InvalidInput&) {
    return turned;
  }
}

}  // namespace kinetix::app
