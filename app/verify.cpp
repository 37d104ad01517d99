#include "app/verify.hpp"

#include <chrono>
#include <cmath>
#include <limits>

namespace kinetix {
namespace {

/// Four times the default step and a quarter of its drive time: what an impatient user would set.
PhysicsOptions hasty(PhysicsOptions options) {
  options.step_s *= 4;
  options.drive_seconds /= 4;
  return options;
}

StateDistance distance(const Structure& structure, const PhysicsResult& physics, const State& reference) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (physics.status != PhysicsResult::Status::settled) return {nan, nan};
  return aligned_distance(structure, physics.state, reference);
}

}  // namespace

void verify(Run& run, const State& reference, const Drive& drive, const PhysicsOptions& options,
            const Progress& progress) {
  PhysicsObserver observer;
  if (progress) observer.progress = [&](double done) { progress("physics run", done); };
  Verification v{options, run_compression(run.structure, drive, options, observer), {}, false};
  v.distance = distance(run.structure, v.physics, reference);
  v.agrees = v.distance.rms <= run.verify_tolerance;
  run.states.push_back({"target", "bullet", run.theta, v.physics.state, v.physics.gaps});
  run.fidelity.push_back({"bullet", v.physics.seconds, v.distance.rms, "exact"});

  const PhysicsResult quick = run_compression(run.structure, drive, hasty(options));
  run.fidelity.push_back(
      {"bullet, step x 4", quick.seconds, distance(run.structure, quick, reference).rms, "exact"});
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
