#include "app/sweep/search_evaluator.hpp"

#include <fmt/ranges.h>

#include "app/result_json.hpp"
#include "app/run_target.hpp"

namespace kinetix {
namespace {

/// The model's state, and the physics run's where there is one.
const NamedState* shown_state(const Run& run, bool physics) {
  const NamedState* shown = nullptr;
  for (const NamedState& state : run.states)
    if (state.name == "target" && (!shown || (physics && state.model == "bullet"))) shown = &state;
  return shown;
}

}  // namespace

void SearchEvaluator::evaluate(SampleRow& row) {
  maker_.make(row.factors);
  const bool physics = plan_.doe.model == Model::bullet;
  const Run run =
      run_target(maker_.target(), {.threads = 1, .seed = plan_.seed, .verify = physics, .progress = {}});
  const auto metrics = metrics_json(run);
  Observation seen{.structure = &run.structure, .theta = run.theta, .metrics = &metrics};
  const NamedState* state = shown_state(run, physics);
  if (!state) throw std::runtime_error("the search ended without a state");
  seen.state = &state->poses;
  for (std::size_t k = 0; k < plan_.responses.size(); ++k) row.responses[k] = plan_.responses[k].of(seen);
  const auto misses = misses_of(run);
  if (!misses.empty()) {
    row.status = SampleStatus::missed;
    row.reason = fmt::format("{}", fmt::join(misses, "; "));
  } else if (run.verification && !run.verification->agrees) {
    row.status = SampleStatus::disagrees;
    row.reason = "the physics run does not agree with the model";
  }
}

}  // namespace kinetix
