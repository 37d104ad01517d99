#pragma once

#include "app/run/run.hpp"
#include "app/sweep/evaluators/evaluator.hpp"
#include "model/lattice/square/family/sheet_reader.hpp"

namespace kinetix::app {

/// Forward runs of a design by the sweep's model, as `simulate` makes them, without writing anything. Convex pieces of imported
/// bodies are made once, unless bores of pins vary.
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
  /// Computes a sample by a run as `simulate` makes it, no more of it than its states and verdict.
  void compute_by_run(const Design& design, SampleRow& row);
  void see_physics(SampleRow& row);
  const model::State& sheet_state(const model::Structure& squares, double theta);

  const SweepPlan& plan_;
  SampleMaker maker_;
  model::State nominal_;  ///< the base's own, where a response needs it

  // of the current sample
  Observation seen_;
  model::State state_;
  model::ExactDesign<double> sheet_;
  Run run_;
  std::optional<Equilibrium> equilibrium_;  ///< near the base's own
};

}  // namespace kinetix::app
