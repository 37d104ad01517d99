#include "app/pipeline/exact_state.hpp"

#include <utility>

#include "app/pipeline/physics_settings.hpp"
#include "app/run/stopwatch.hpp"
#include "model/base/invalid_input.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

constexpr int timed_calls = 200;  // enough for the clock to resolve the mean, microseconds for small sheets

void add(Run& run, const std::string& name, double theta) {
  model::State state = run.plan.exact.at(theta);
  const model::HingeGaps gaps = hinge_gaps(run.design.structure, state);
  run.states.push_back({name, to_string(Model::exact), theta, std::move(state), gaps});
}

}  // namespace

void require_exact(const Run& run) {
  if (!run.plan.exact)
    throw InvalidInput("the design that was found has no exact motion: " + run.plan.exact.why);
}

void add_exact_state(Run& run, double theta) {
  require_exact(run);
  run.theta = theta;
  add(run, "target", theta);
  run.fidelity.push_back(exact_fidelity(run.plan.exact, run.design.structure, theta));
}

void add_exact_frames(Run& run) {
  for (int k = 0; k < motion_states; ++k) add(run, "frame", run.theta * k / (motion_states - 1));
}

PhysicsTask folding_task(const Run& run) {
  return {run.states.front().poses, drive_to(run.design.structure, run.theta),
          rotary_physics(run.design.hinge, run.design.physics, run.design.structure.size().edge_mm)};
}

Fidelity exact_fidelity(const model::ExactMotion& exact, const model::Linkage& structure, double theta) {
  model::State state;
  Stopwatch watch;
  for (int k = 0; k < timed_calls; ++k) state = exact.at(theta);
  const double seconds = watch.lap() / timed_calls;
  return {to_string(Model::exact), seconds, hinge_gaps(structure, state).max, "its own hinge closure"};
}

}  // namespace kinetix::app
