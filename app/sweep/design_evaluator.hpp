#pragma once

#include "app/run.hpp"
#include "app/sweep/evaluator.hpp"
#include "model/sheet_reader.hpp"

namespace kinetix {

/// Forward runs of a design by the sweep's model, as `simulate` makes them, without writing anything.
class DesignEvaluator final : public Evaluator {
 public:
  explicit DesignEvaluator(const SweepPlan& plan);
  void evaluate(SampleRow& row) override;

 private:
  void compute(const DesignFile& design, SampleRow& row);
  void compute_exact(const DesignFile& design);
  void compute_balance(const DesignFile& design, SampleRow& row);
  void compute_near_base(const DesignFile& design, SampleRow& row);
  void see_balance(const DesignFile& design, LoadPath path, SampleRow& row);
  void find_nominal();
  void compute_physics(const DesignFile& design, SampleRow& row);
  const State& sheet_state(const DesignFile& design);

  const SweepPlan& plan_;
  SampleMaker maker_;
  State nominal_;  ///< the base's own, where a response needs it

  // of the current sample
  Observation seen_;
  State state_;
  ExactDesign<double> sheet_;
  Run run_;
  PhysicsResult physics_;
};

}  // namespace kinetix
