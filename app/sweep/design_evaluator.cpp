#include "app/sweep/design_evaluator.hpp"

#include <algorithm>
#include <limits>

#include "app/balance.hpp"
#include "app/design_motion.hpp"
#include "model/classify.hpp"
#include "model/elastic/near_balance.hpp"

namespace kinetix {
namespace {

constexpr int frames = 13;                 // as `simulate` has them: they decide the steps of the load path
constexpr double verify_tolerance = 0.02;  // cell edges, as that of `verify`

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool is_rectangle(const Structure& s, const ExactDesign<double>& d) {
  return s.bodies.size() == static_cast<std::size_t>(d.columns() + 1) * (d.rows() + 1);
}

Run balance_run(const DesignFile& design) {
  Run run;
  run.hinge = design.hinge;
  run.side = design.side;
  run.structure = design.structure;
  run.plan.family = classify(design.structure);
  run.plan.model = Model::equilibrium;
  run.plan.planar = all_vertical(design.structure);
  add_balance(run, drive_of(design), elasticity_of(design), frames, {});
  return run;
}

/// The closed form of a design's drive; empty where no family fits.
State exact_state(const DesignFile& design, double& theta) {
  const Classification family = classify(design.structure);
  if (family.family == Family::none) return {};
  theta = theta_of(drive_of(design), family, design.structure);
  return fold(family, design.structure, theta);
}

}  // namespace

DesignEvaluator::DesignEvaluator(const SweepPlan& plan) : plan_(plan), maker_(plan) {
  const bool compares = std::any_of(plan.responses.begin(), plan.responses.end(),
                                    [](const Metric& metric) { return metric.needs_nominal; });
  if (compares || plan.doe.from_base) find_nominal();
}

/// A sweep that starts from the base's state takes it from the closed form where there is one: there its
/// branch is that of the design, whatever a load from flat would choose.
void DesignEvaluator::find_nominal() {
  const DesignFile& base = *plan_.base.design;
  SampleRow row;
  if (plan_.doe.from_base && classify(base.structure).family != Family::none)
    see_balance(base, balance_at_closed_form(base.structure, elasticity_of(base), drive_of(base)), row);
  else if (plan_.doe.from_base)
    compute_balance(base, row);
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
  for (std::size_t k = 0; k < plan_.responses.size(); ++k) row.responses[k] = plan_.responses[k].of(seen_);
}

void DesignEvaluator::compute(const DesignFile& design, SampleRow& row) {
  seen_ = {.structure = &design.structure,
           .theta = design.theta,
           .nominal = &nominal_,
           .goal = plan_.goal ? &*plan_.goal : nullptr};
  switch (plan_.doe.model) {
    case Model::exact:
      return compute_exact(design);
    case Model::equilibrium:
      return plan_.doe.from_base ? compute_near_base(design, row) : compute_balance(design, row);
    case Model::bullet:
      return compute_physics(design, row);
  }
}

/// Rectangles are folded in place; the order of their bodies is that of the lattice.
const State& DesignEvaluator::sheet_state(const DesignFile& design) {
  sheet_.theta = design.theta;
  if (is_rectangle(design.structure, sheet_))
    fold(sheet_, design.structure.size.edge_mm, state_);
  else
    state_ = fold(sheet_, design.structure);
  return state_;
}

void DesignEvaluator::compute_exact(const DesignFile& design) {
  if (!design.drive && SheetReader(design.structure).read(design.structure, sheet_)) {
    seen_.state = &sheet_state(design);
    return;
  }
  const Classification family = classify(design.structure);
  if (family.family == Family::none) throw InvalidInput(family.why);
  seen_.theta = design.drive ? theta_of(drive_of(design), family, design.structure) : design.theta;
  state_ = fold(family, design.structure, seen_.theta);
  seen_.state = &state_;
}

void DesignEvaluator::compute_balance(const DesignFile& design, SampleRow& row) {
  run_ = balance_run(design);
  seen_.theta = run_.theta;
  seen_.state = &run_.states.front().poses;
  seen_.balance = &*run_.equilibrium;
  if (run_.equilibrium->reached()) return;
  row.status = SampleStatus::missed;
  row.reason = to_string(run_.equilibrium->path.stop) + ": " + run_.equilibrium->path.why;
}

void DesignEvaluator::compute_near_base(const DesignFile& design, SampleRow& row) {
  see_balance(design,
              follow_change(plan_.base.design->structure, nominal_, design.structure, elasticity_of(design),
                            drive_of(design)),
              row);
}

void DesignEvaluator::see_balance(const DesignFile& design, LoadPath path, SampleRow& row) {
  run_ = {};
  run_.equilibrium = Equilibrium{elasticity_of(design), drive_of(design), std::move(path), {}, {}};
  const LoadPath& found = run_.equilibrium->path;
  if (found.steps.empty()) throw InvalidInput(found.why);
  seen_.structure = &design.structure;
  seen_.theta = found.theta;
  seen_.state = &found.state;
  seen_.balance = &*run_.equilibrium;
  if (found.stop == LoadPath::Stop::reached) return;
  row.status = SampleStatus::missed;
  row.reason = found.why;
}

void DesignEvaluator::compute_physics(const DesignFile& design, SampleRow& row) {
  State reference;
  if (design.hinge.model == HingeSection::Model::elastic) {
    run_ = balance_run(design);
    if (run_.equilibrium->reached()) reference = run_.states.front().poses;
    seen_.theta = run_.theta;
  } else {
    reference = exact_state(design, seen_.theta);
  }
  physics_ =
      run_compression(design.structure, drive_of(design), physics_of(design, all_vertical(design.structure)));
  if (physics_.status != PhysicsResult::Status::settled)
    throw InvalidInput("physics run " + to_string(physics_.status) + ": " + physics_.why);
  seen_.state = &physics_.state;
  seen_.physics = &physics_;
  seen_.from_model = reference.empty() ? StateDistance{nan, nan}
                                       : aligned_distance(design.structure, physics_.state, reference);
  if (reference.empty() || seen_.from_model.rms <= verify_tolerance) return;
  row.status = SampleStatus::disagrees;
  row.reason = "the physics run settled in another state than the model";
}

}  // namespace kinetix
