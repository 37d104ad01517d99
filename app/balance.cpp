#include "app/balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "app/design_motion.hpp"
#include "app/verify.hpp"
#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

constexpr double steps_per_frame = 2;
constexpr double step_in_contact = 0.01;  // rad; in longer ones jammed walls may change their branch

/// Keeps states of a motion at even distances of theta, closer than the frames that are wanted in the end.
class FrameKeeper {
 public:
  FrameKeeper(double goal, int frames) : spacing_(std::abs(goal) / (steps_per_frame * frames)) {}

  void see(double theta, const State& state) {
    if (!kept_.empty() && std::abs(theta - kept_.back().theta) < spacing_) return;
    kept_.push_back({"frame", to_string(Model::equilibrium), theta, state, {}});
  }

  /// Those nearest to `count` even distances up to `last`.
  std::vector<NamedState> even(double last, int count) const {
    std::vector<NamedState> frames;
    for (int k = 0; k < count; ++k) {
      const NamedState& frame = nearest(last * k / (count - 1));
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
};

std::string stiffness_sentence(const Run& run, const Elasticity& e) {
  const char* start = run.hinge.model == HingeSection::Model::rotary
                          ? "the design's hinges are rotary; for this model they are taken as elastic: "
                          : "elastic hinges: ";
  return fmt::format("{}k_point {:g} N/mm, k_turn {:g} N mm/rad, reach_mm {:g}, k_contact {:g} N/mm", start,
                     e.k_point, e.k_turn, e.reach_mm, e.k_contact);
}

LoadPathOptions options_of(const Run& run, double goal, int frames) {
  LoadPathOptions options;
  options.planar = run.plan.planar;
  options.side = run.side;
  const double frame = std::abs(goal) / (frames - 1);
  if (frame > 0) options.longest_step = std::clamp(frame, options.first_step, options.longest_step);
  return options;
}

bool touched(const LoadPath& path) {
  return std::any_of(path.events.begin(), path.events.end(),
                     [](const PathEvent& e) { return e.kind == PathEvent::Kind::contact; });
}

/// Follows the path, and where walls touch on it, once more in short steps.
LoadPath follow(Run& run, const Drive& drive, const Elasticity& elasticity, FrameKeeper& keeper, int frames,
                const Progress& progress) {
  const double goal = drive.theta();
  const FrameKeeper empty = keeper;
  const auto see = [&](const LoadStep& step, const State& state) {
    keeper.see(step.theta, state);
    if (progress) progress("load path", goal == 0 ? 1 : step.theta / goal);
  };
  LoadPathOptions options = options_of(run, goal, frames);
  LoadPath path = follow_load(run.structure, elasticity, drive, options, see);
  if (!touched(path) || options.longest_step <= step_in_contact) return path;
  run.plan.why.push_back(fmt::format("walls touch: followed in steps of {:g} rad", step_in_contact));
  keeper = empty;
  options.first_step = options.longest_step = step_in_contact;
  return follow_load(run.structure, elasticity, drive, options, see);
}

/// The drive, as far as the path came.
Drive reached_drive(const Equilibrium& balance) {
  Drive drive = balance.drive;
  (drive.kind == Drive::Kind::plates ? drive.compression : drive.angle) = balance.path.steps.back().drive;
  return drive;
}

/// The closed form of the same drive, and how far the balance is from it.
void add_exact(Run& run) {
  Equilibrium& balance = *run.equilibrium;
  try {
    const double theta = theta_of(reached_drive(balance), run.plan.family, run.structure);
    State exact = fold(run.plan.family, run.structure, theta);
    balance.from_exact = aligned_distance(run.structure, balance.path.state, exact);
    const HingeGaps gaps = hinge_gaps(run.structure, exact);
    run.states.push_back({"target", to_string(Model::exact), theta, std::move(exact), gaps});
    run.fidelity.push_back(exact_fidelity(run.plan.family, run.structure, theta));
  } catch (const InvalidInput& e) {
    run.plan.why.push_back("no closed form to compare with: " + e.reason());
  }
}

void add_frames(Run& run, const std::vector<NamedState>& frames) {
  for (NamedState frame : frames) {
    frame.gaps = hinge_gaps(run.structure, frame.poses);
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

void add_balance(Run& run, const Drive& drive, const Elasticity& elasticity, int frames,
                 const Progress& progress) {
  run.plan.why.push_back(stiffness_sentence(run, elasticity));
  FrameKeeper keeper(drive.theta(), frames);
  const auto start = std::chrono::steady_clock::now();
  LoadPath path = follow(run, drive, elasticity, keeper, frames, progress);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.theta = path.theta;
  run.states.push_back({"target", to_string(Model::equilibrium), path.theta, path.state, path.gaps});
  run.equilibrium = Equilibrium{elasticity, drive, std::move(path), {}};
  if (run.plan.family.family != Family::none) add_exact(run);
  add_fidelity(run, seconds);
  add_frames(run, keeper.even(run.theta, frames));
}

}  // namespace kinetix
