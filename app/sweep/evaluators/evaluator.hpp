#pragma once

#include <functional>
#include <memory>

#include "app/result/verdict.hpp"
#include "app/sweep/evaluators/sample_row.hpp"
#include "app/sweep/plan/sample_maker.hpp"

namespace kinetix::app {

/// Computes samples one after the other; one for each thread.
class Evaluator {
 public:
  virtual ~Evaluator() = default;

  /// Fills responses, status and reason of a row whose factors are there. @throws whatever goes wrong
  virtual void evaluate(SampleRow& row) = 0;
};

/// @param plan must outlive it. @throws InvalidInput where the base's own state is needed and there is none
std::unique_ptr<Evaluator> make_evaluator(const SweepPlan& plan);

using EvaluatorMaker = std::function<std::unique_ptr<Evaluator>(const SweepPlan&)>;

/// The row's status and, unless it is ok, its reason.
void take_verdict(const RunVerdict& verdict, SampleRow& row);

/// Sample number `sample` of the plan. What it throws becomes its reason.
SampleRow run_sample(const SweepPlan& plan, Evaluator& evaluator, std::int64_t sample) noexcept;

}  // namespace kinetix::app
