#include "app/sweep/evaluators/bodies_evaluator.hpp"

#include <algorithm>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {

BodiesEvaluator::BodiesEvaluator(const SweepPlan& plan) : plan_(plan), maker_(plan) {
  if (std::none_of(plan.responses.begin(), plan.responses.end(),
                   [](const Metric& metric) { return metric.needs_nominal; }))
    return;
  SampleRow row;
  compute(*plan.base.bodies, row);
  if (row.status != SampleStatus::ok)
    throw InvalidInput("the base's own state, which samples are compared with, was not found: " + row.reason,
                       {plan_.doe.base});
  nominal_ = *seen_.state;
}

void BodiesEvaluator::evaluate(SampleRow& row) {
  maker_.make(row.factors);
  compute(maker_.bodies(), row);
  for (std::size_t k = 0; k < plan_.responses.size(); ++k) row.responses[k] = plan_.responses[k].of(seen_);
}

void BodiesEvaluator::compute(const AssemblyFile& file, SampleRow& row) {
  run_ = run_assembly(file, plan_.doe.model, {}, {.threads = 1, .progress = {}}, std::move(run_.pieces));
  seen_ = {
      .linkage = &run_.linkage, .assembly = &run_.file.assembly, .theta = run_.theta, .nominal = &nominal_};
  switch (plan_.doe.model) {
    case Model::exact:
      return see_exact(row);
    case Model::equilibrium:
      return see_equilibrium(row);
    case Model::bullet:
      return see_physics(row);
  }
}

void BodiesEvaluator::see_exact(SampleRow& row) {
  seen_.theta = run_.states.front().theta;
  seen_.state = &run_.states.front().poses;
  take_verdict(verdict_of(run_), row);
}

void BodiesEvaluator::see_equilibrium(SampleRow& row) {
  equilibrium_ = Equilibrium{elasticity_of(run_.file.assembly), run_.drive(), *run_.equilibrium, {}, {}};
  const model::EquilibriumPath& path = equilibrium_->path;
  if (run_.motion.reached && equilibrium_->reached())
    equilibrium_->from_exact = aligned_distance(run_.linkage, path.state, run_.motion.states.back());
  seen_.theta = path.theta;
  seen_.state = &path.state;
  seen_.equilibrium = &*equilibrium_;
  take_verdict(verdict_of(run_), row);
}

void BodiesEvaluator::see_physics(SampleRow& row) {
  const Verification& v = *run_.verification;
  if (v.physics.status != sim::PhysicsResult::Status::settled)
    throw InvalidInput("physics run " + to_string(v.physics.status) + ": " + v.physics.why);
  seen_.state = &v.physics.state;
  seen_.physics = &v.physics;
  seen_.from_model = v.distance;
  take_verdict(verdict_of(run_), row);
}

}  // namespace kinetix::app
