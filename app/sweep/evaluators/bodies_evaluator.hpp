#pragma once

#include "app/assembly/assembly_run.hpp"
#include "app/sweep/evaluators/evaluator.hpp"

namespace kinetix::app {

/// Forward runs of a design of general bodies by the sweep's model, as `simulate` makes them, without writing anything. Convex pieces
/// are made once, unless bores of pins vary.
class BodiesEvaluator final : public Evaluator {
 public:
  explicit BodiesEvaluator(const SweepPlan& plan);
  void evaluate(SampleRow& row) override;

 private:
  void compute(const AssemblyFile& file, SampleRow& row);
  void see_exact(SampleRow& row);
  void see_equilibrium(SampleRow& row);
  void see_physics(SampleRow& row);

  const SweepPlan& plan_;
  SampleMaker maker_;
  model::State nominal_;  ///< the base's own, where a response needs it

  // of the current sample
  AssemblyRun run_;
  std::optional<Equilibrium> equilibrium_;
  Observation seen_;
};

}  // namespace kinetix::app
