#include "app/sweep/evaluators/design_evaluator.hpp"

#include <algorithm>

#include "app/pipeline/design_drive.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/pipeline/verify.hpp"
#include "app/result/verdict.hpp"
#include "model/elastic/path/near_equilibrium.hpp"
#include "model/sheet/sheet_motion.hpp"
#include "optim/doe/nan.hpp"

namespace kinetix::app {

DesignEvaluator::DesignEvaluator(const SweepPlan& plan) : plan_(plan), maker_(plan) {
  const bool compares = std::any_of(plan.responses.begin(), plan.responses.end(),
                                    [](const Metric& metric) { return metric.needs_nominal; });
  if (compares || plan.doe.from_base) find_nominal();
}

/// A sweep that starts from the base's state takes it from the closed form where there is one: there its
/// branch is that of the design, whatever a load from flat would choose.
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
  // Where no equilibrium is found near the base's, the search ends in a state of a part of the change, at rest nowhere.
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

/// Rectangles are folded in place; the order of their bodies is that of the lattice.
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
  take_verdict(verdict_of(run_), row);
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
  take_verdict(verdict, row);
}

void DesignEvaluator::see_physics(SampleRow& row) {
  const Verification& v = *run_.verification;
  if (!is_settled(v)) throw InvalidInput("physics run " + to_string(v.physics.status) + ": " + v.physics.why);
  seen_.state = &v.physics.state;
  seen_.physics = &v.physics;
  seen_.from_model = v.distance;
  take_verdict(verdict_of(run_), row);
}

}  // namespace kinetix::app
