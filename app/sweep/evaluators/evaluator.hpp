#pragma once

#include "app/result/verdict.hpp"
#include "app/sweep/plan/sweep_plan.hpp"

namespace kinetix::app {

/// Outcome of a sample; the same cases as the exit codes of a single run.
enum class SampleStatus { ok, missed, disagrees, failed };

std::string to_string(SampleStatus status);

/// One row of a sweep's table.
struct SampleRow {
  std::int64_t sample = 0;
  std::vector<double> factors;  ///< in the units of the keys that they vary
  /// In the units of their metrics. NaN: no such number. All NaN in a failed sample.
  std::vector<double> responses;
  SampleStatus status = SampleStatus::ok;
  std::string reason;  ///< sentence for people; empty if ok
};

/// Computes samples one after the other. Each thread has one.
class Evaluator {
 public:
  virtual ~Evaluator() = default;

  /// Fills responses, status and reason of a row that has its factors. @throws any exception of the
  /// computation
  virtual void evaluate(SampleRow& row) = 0;
};

/// @param plan must outlive it. @throws InvalidInput if the base's state is needed and is not found
std::unique_ptr<Evaluator> make_evaluator(const SweepPlan& plan);

using EvaluatorMaker = std::function<std::unique_ptr<Evaluator>(const SweepPlan&)>;

/// Sets the row's status and, unless it is ok, its reason.
void copy_verdict(const RunVerdict& verdict, SampleRow& row);

/// Computes sample number `sample` of the plan. The text of an exception becomes the row's reason.
SampleRow run_sample(const SweepPlan& plan, Evaluator& evaluator, std::int64_t sample) noexcept;

}  // namespace kinetix::app
