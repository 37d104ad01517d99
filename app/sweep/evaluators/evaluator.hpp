#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/result/verdict.hpp"
#include "app/sweep/plan/sweep_plan.hpp"

namespace kinetix::app {

/// How a sample ended: as the exit codes of a single run.
enum class SampleStatus { ok, missed, disagrees, failed };

std::string to_string(SampleStatus status);

/// One row of a sweep's table.
struct SampleRow {
  std::int64_t sample = 0;
  std::vector<double> factors;  ///< in units of the keys that they vary
  /// In units of their metrics; NaN where there is no number; all of them in a failed sample.
  std::vector<double> responses;
  SampleStatus status = SampleStatus::ok;
  std::string reason;  ///< in words, empty where ok
};

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
