#include "app/pipeline/exact_state.hpp"

#include <utility>

#include "app/run/stopwatch.hpp"

namespace kinetix::app {
namespace {

constexpr int timed_calls = 200;  // enough for the clock to resolve the mean, microseconds for small sheets

}  // namespace

NamedState exact_state(const Found& found, const std::string& name, double theta) {
  model::State own = found.motion ? found.motion(theta) : found.plan.exact.at(theta);
  const model::HingeGaps gaps = hinge_gaps(found.design.structure, own);
  if (found.to_shown) own = moved(std::move(own), *found.to_shown);
  return {name, to_string(Model::exact), theta, std::move(own), gaps};
}

std::vector<NamedState> exact_frames(const Found& found) {
  std::vector<NamedState> out;
  for (int k = 0; k < motion_states; ++k)
    out.push_back(exact_state(found, "frame", found.theta * k / (motion_states - 1)));
  return out;
}

Fidelity exact_fidelity(const model::ExactMotion& exact, const model::Linkage& structure, double theta) {
  model::State state;
  Stopwatch watch;
  for (int k = 0; k < timed_calls; ++k) state = exact.at(theta);
  const double seconds = watch.lap() / timed_calls;
  return {to_string(Model::exact), seconds, hinge_gaps(structure, state).max, "its own hinge closure"};
}

}  // namespace kinetix::app
