#pragma once

#include "app/sweep/evaluators/evaluator.hpp"

namespace kinetix::app {

/// A search for a target in every sample, as `kinetix-opt TARGET.yaml` makes it on one thread.
class SearchEvaluator final : public Evaluator {
 public:
  explicit SearchEvaluator(const SweepPlan& plan) : plan_(plan), maker_(plan) {}
  void evaluate(SampleRow& row) override;

 private:
  const SweepPlan& plan_;
  SampleMaker maker_;
};

}  // namespace kinetix::app
