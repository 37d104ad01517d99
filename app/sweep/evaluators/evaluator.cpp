#include "app/sweep/evaluators/evaluator.hpp"

#include <new>
#include <nlohmann/json.hpp>

#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/physics.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/fit.hpp"
#include "app/result/result_json.hpp"
#include "model/elastic/path/near_equilibrium.hpp"
#include "optim/doe/analysis.hpp"

namespace kinetix::app {
namespace {

/// Searches for a target in every sample, as `kinetix-opt TARGET.yaml` does on one thread.
class SearchEvaluator final : public Evaluator {
 public:
  explicit SearchEvaluator(const SweepPlan& plan) : plan_(plan), maker_(plan) {}
  void evaluate(SampleRow& row) override;

 private:
  const SweepPlan& plan_;
  SampleMaker maker_;
};

/// Returns the simulation's state if `physics` is set and there is one, else the model's state. Null without
/// any.
const NamedState* shown_state(const Run& run, bool physics) {
  const NamedState* shown = nullptr;
  for (const NamedState& state : run.states)
    if (state.name == "target" && (!shown || (physics && state.model == "bullet"))) shown = &state;
  return shown;
}

/// Returns the answer of `export` without a default lock: samples are not printed.
PrintAnswer answer_to_sample(const Design& design) {
  PrintAnswer answer = answer_of_export(design);
  answer.add_lock = {};
  return answer;
}

void SearchEvaluator::evaluate(SampleRow& row) {
  maker_.make(row.factors);
  const bool physics = plan_.doe.model == Model::bullet;
  const Run run = run_goal(
      *maker_.target().goal,
      {.threads = 1, .seed = plan_.seed, .verify = physics, .progress = {}, .printable = answer_to_sample});
  const auto metrics = metrics_json(run);
  Observation seen{.structure = &run.design.structure, .theta = run.theta, .metrics = &metrics};
  const NamedState* state = shown_state(run, physics);
  if (!state) throw std::runtime_error("the search ended without a state");
  seen.state = &state->poses;
  seen.is_closed_form = state->model == to_string(Model::exact);
  for (std::size_t k = 0; k < plan_.responses.size(); ++k) row.responses[k] = plan_.responses[k].of(seen);
  copy_verdict(verdict_of(run), row);
}

/// Runs a design forwards by the sweep's model, as `simulate` does, without writing files. Convex pieces of
/// imported bodies are computed once, unless pin bores vary.
class DesignEvaluator final : public Evaluator {
 public:
  explicit DesignEvaluator(const SweepPlan& plan);
  void evaluate(SampleRow& row) override;

 private:
  void compute(const Design& design, SampleRow& row);
  void compute_exact(const Design& design);
  void compute_near_base(const Design& design, SampleRow& row);
  void see_equilibrium(const Design& design, model::EquilibriumPath path, SampleRow& row);
  void find_nominal();
  /// Computes a sample by a run as `simulate` does, without certificates and in brief form.
  void compute_by_run(const Design& design, SampleRow& row);
  void see_physics(SampleRow& row);
  const model::State& sheet_state(const model::Structure& squares, double theta);

  const SweepPlan& plan_;
  SampleMaker maker_;
  model::State nominal_;  ///< of the base; set if a response or `start: base` needs it

  // Current sample:
  Observation seen_;
  model::State state_;
  model::ExactDesign<double> sheet_;
  Run run_;
  std::optional<Equilibrium> equilibrium_;  ///< found from the base's state
};

DesignEvaluator::DesignEvaluator(const SweepPlan& plan) : plan_(plan), maker_(plan) {
  const bool compares = std::any_of(plan.responses.begin(), plan.responses.end(),
                                    [](const Metric& metric) { return metric.needs_nominal; });
  if (compares || plan.doe.from_base) find_nominal();
}

/// Finds the base's state. A sweep that starts from it uses the closed form, if there is one: this fixes the
/// branch, which a load from flat might not reach.
void DesignEvaluator::find_nominal() {
  const Design& base = *plan_.base.design;
  SampleRow row;
  const model::ExactMotion exact = plan_.doe.from_base ? exact_motion(base.structure) : model::ExactMotion{};
  if (exact)
    see_equilibrium(
        base, equilibrium_at_closed_form({base.structure, drive_of(base), exact}, elasticity_of(base)), row);
  else if (plan_.doe.from_base)
    compute_by_run(base, row);
  else
    compute(base, row);
  if (row.status != SampleStatus::ok)
    throw InvalidInput("the base's own state, which samples are compared with, was not found: " + row.reason,
                       {plan_.doe.base});
  nominal_ = *seen_.state;
}

void DesignEvaluator::evaluate(SampleRow& row) {
  maker_.make(row.factors);
  compute(maker_.design(), row);
  // If no equilibrium is found near the base's, the state belongs to a part of the change and is not at rest.
  const bool is_lost = plan_.doe.from_base && row.status != SampleStatus::ok;
  for (std::size_t k = 0; k < plan_.responses.size(); ++k) {
    const Metric& metric = plan_.responses[k];
    row.responses[k] = is_lost && metric.name != "reached" ? optim::nan : metric.of(seen_);
  }
}

void DesignEvaluator::compute(const Design& design, SampleRow& row) {
  seen_ = {.structure = &design.structure,
           .theta = design.theta,
           .nominal = &nominal_,
           .goal = plan_.goal.goal.get()};
  if (plan_.doe.from_base) return compute_near_base(design, row);
  if (plan_.doe.model == Model::exact && !design.structure.assembly()) return compute_exact(design);
  compute_by_run(design, row);
}

/// Folds a whole sheet in place, since its bodies have the lattice's order; folds other sheets by the general
/// function.
const model::State& DesignEvaluator::sheet_state(const model::Structure& squares, double theta) {
  sheet_.theta = theta;
  if (is_whole_sheet(sheet_, squares))
    fold(sheet_, squares.size.edge_mm, state_);
  else
    state_ = fold(sheet_, squares);
  return state_;
}

void DesignEvaluator::compute_exact(const Design& design) {
  seen_.is_closed_form = true;
  const model::Structure* squares = design.structure.squares();
  if (squares && !design.drive && model::SheetReader(*squares).read(*squares, sheet_)) {
    seen_.state = &sheet_state(*squares, design.theta);
    return;
  }
  const model::ExactMotion exact = exact_motion(design.structure);
  if (!exact) throw InvalidInput(exact.why);
  seen_.theta = design.drive ? exact_theta_of(design, exact) : design.theta;
  state_ = exact.at(seen_.theta);
  seen_.state = &state_;
}

void DesignEvaluator::compute_by_run(const Design& design, SampleRow& row) {
  RunOptions options;
  options.threads = 1;
  options.certify = false;
  options.brief = true;
  options.pieces = run_.pieces;
  run_ = run_design(design, plan_.doe.model, std::move(options));
  seen_.theta = run_.theta;
  if (run_.verification) return see_physics(row);
  seen_.theta = run_.states.front().theta;
  seen_.state = &run_.states.front().poses;
  if (run_.equilibrium) seen_.equilibrium = &*run_.equilibrium;
  copy_verdict(verdict_of(run_), row);
}

void DesignEvaluator::compute_near_base(const Design& design, SampleRow& row) {
  see_equilibrium(
      design,
      follow_change(nominal_, changing(plan_.base.design->structure, design.structure, drive_of(design)),
                    elasticity_of(design)),
      row);
}

void DesignEvaluator::see_equilibrium(const Design& design, model::EquilibriumPath path, SampleRow& row) {
  if (path.steps.empty()) throw InvalidInput(path.why);
  equilibrium_ = Equilibrium{elasticity_of(design), drive_of(design), std::move(path), {}, {}};
  seen_.structure = &design.structure;
  seen_.theta = reached_theta(design.structure, exact_motion(design.structure), equilibrium_->drive,
                              equilibrium_->path, equilibrium_->elasticity);
  seen_.state = &equilibrium_->path.state;
  seen_.equilibrium = &*equilibrium_;
  RunVerdict verdict;
  verdict.set(&RunVerdict::reaches, drive_reasons(*equilibrium_, seen_.theta), "elastic");
  copy_verdict(verdict, row);
}

void DesignEvaluator::see_physics(SampleRow& row) {
  const Verification& v = *run_.verification;
  if (!is_settled(v)) throw InvalidInput("simulation " + to_string(v.physics.status) + ": " + v.physics.why);
  seen_.state = &v.physics.state;
  seen_.physics = &v.physics;
  seen_.from_model = v.distance;
  copy_verdict(verdict_of(run_), row);
}

void fail(SampleRow& row, const SweepPlan& plan, const std::string& why) {
  row.status = SampleStatus::failed;
  row.reason = why;
  row.responses.assign(plan.responses.size(), optim::nan);
}

}  // namespace

std::string to_string(SampleStatus status) {
  switch (status) {
    case SampleStatus::ok:
      return "ok";
    case SampleStatus::missed:
      return "missed";
    case SampleStatus::disagrees:
      return "disagrees";
    case SampleStatus::failed:
      break;
  }
  return "failed";
}

std::unique_ptr<Evaluator> make_evaluator(const SweepPlan& plan) {
  if (plan.searches()) return std::make_unique<SearchEvaluator>(plan);
  return std::make_unique<DesignEvaluator>(plan);
}

void copy_verdict(const RunVerdict& verdict, SampleRow& row) {
  const ExitCode code = exit_code(verdict);
  row.status = code == target_missed       ? SampleStatus::missed
               : code == physics_disagrees ? SampleStatus::disagrees
                                           : SampleStatus::ok;
  row.reason = verdict.reasons();
}

SampleRow run_sample(const SweepPlan& plan, Evaluator& evaluator, std::int64_t sample) noexcept {
  SampleRow row;
  row.sample = sample;
  row.factors.resize(plan.samples.factors().size());
  row.responses.resize(plan.responses.size());
  plan.samples.sample(static_cast<std::uint64_t>(sample), row.factors);
  try {
    evaluator.evaluate(row);
  } catch (const InvalidInput& e) {
    fail(row, plan, (e.place().key.empty() ? "" : e.place().key + ": ") + e.reason());
  } catch (const std::bad_alloc&) {
    fail(row, plan, "there is not enough memory");
  } catch (const std::exception& e) {
    fail(row, plan, e.what());
  } catch (...) {
    fail(row, plan, "an unknown exception");
  }
  return row;
}

}  // namespace kinetix::app
