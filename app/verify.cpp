#include "app/verify.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>

namespace kinetix {
namespace {

constexpr double longest_step_s = 0.1;
constexpr double stiff_joints = 1e8;

PhysicsOptions with_steps(PhysicsOptions options, double factor) {
  options.step_s *= factor;
  return options;
}

/// A net never strains, and its ribs are long: joints that yield let their ends sway far behind.
PhysicsOptions suited_to(const Classification& family, PhysicsOptions options) {
  if (family.family == Family::F4 && !options.elastic) options.joint_stiffness = stiff_joints;
  return options;
}

StateDistance distance(const Structure& structure, const PhysicsResult& physics, const State& reference) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(physics.gaps.max)) return {nan, nan};
  return aligned_distance(structure, physics.state, reference);
}

/// Sheets of elastic hinges may have several balances.
std::optional<BalanceComparison> balances(const Run& run, const Verification& v, const State& reference) {
  const bool settled = v.physics.status == PhysicsResult::Status::settled;
  if (!settled || !v.compared || !run.equilibrium) return std::nullopt;
  const Equilibrium& balance = *run.equilibrium;
  return compare_balances(
      {run.structure, balance.elasticity, balance.drive, v.options.planar, v.options.contact},
      v.physics.state, reference, run.verify_tolerance);
}

void add_fidelity(Run& run, const std::string& model, const PhysicsResult& physics, const State& reference) {
  const double rms = distance(run.structure, physics, reference).rms;
  run.fidelity.push_back(
      {model + " (" + to_string(physics.status) + ")", physics.seconds, rms, to_string(run.plan.model)});
}

}  // namespace

void verify(Run& run, const State& reference, const Drive& drive, const PhysicsOptions& asked,
            const Progress& progress) {
  const PhysicsOptions options = suited_to(run.plan.family, asked);
  PhysicsObserver observer;
  if (progress) observer.progress = [&](double done) { progress("physics run", done); };
  Verification v;
  v.options = options;
  v.physics = run_compression(run.structure, drive, options, observer);
  v.compared = !reference.empty();
  const bool settled = v.physics.status == PhysicsResult::Status::settled;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  v.distance =
      settled && v.compared ? distance(run.structure, v.physics, reference) : StateDistance{nan, nan};
  v.agrees = settled && (!v.compared || v.distance.rms <= run.verify_tolerance);
  v.balance = balances(run, v, reference);
  run.states.push_back({"target", "bullet", run.theta, v.physics.state, v.physics.gaps});
  if (v.compared) {
    add_fidelity(run, "bullet", v.physics, reference);
    for (const double factor : {4.0, 16.0})
      if (options.step_s * factor <= longest_step_s)
        add_fidelity(run, fmt::format("bullet, {} x step", factor),
                     run_compression(run.structure, drive, with_steps(options, factor)), reference);
  }
  run.verification = std::move(v);
}

Fidelity exact_fidelity(const Classification& family, const Structure& structure, double theta) {
  constexpr int calls = 200;
  State state;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < calls; ++k) state = fold(family, structure, theta);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {"exact", seconds / calls, hinge_gaps(structure, state).max, "its own hinge closure"};
}

std::vector<NamedState> motion_frames(const Classification& family, const Structure& structure, double theta,
                                      int count) {
  std::vector<NamedState> frames;
  for (int k = 0; k < count; ++k) {
    const double angle = theta * k / (count - 1);
    State state = fold(family, structure, angle);
    const HingeGaps gaps = hinge_gaps(structure, state);
    frames.push_back({"frame", "exact", angle, std::move(state), gaps});
  }
  return frames;
}

}  // namespace kinetix
