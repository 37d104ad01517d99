#include "app/sweep/evaluators/search_evaluator.hpp"

#include <nlohmann/json.hpp>

#include "app/pipeline/pipeline.hpp"
#include "app/print/fit.hpp"
#include "app/result/result_json.hpp"
#include "app/result/verdict.hpp"

namespace kinetix::app {
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
  const Run run = run_goal(
      *maker_.target().goal,
      {.threads = 1, .seed = plan_.seed, .verify = physics, .progress = {}, .printable = answer_of_export});
  const auto metrics = metrics_json(run);
  Observation seen{.structure = &run.design.structure, .theta = run.theta, .metrics = &metrics};
  const NamedState* state = shown_state(run, physics);
  if (!state) throw std::runtime_error("the search ended without a state");
  seen.state = &state->poses;
  seen.is_closed_form = state->model == to_string(Model::exact);
  for (std::size_t k = 0; k < plan_.responses.size(); ++k) row.responses[k] = plan_.responses[k].of(seen);
  take_verdict(verdict_of(run), row);
}

}  // namespace kinetix::app
