#include "app/sweep/evaluators/evaluator.hpp"

#include <new>

#include "app/sweep/evaluators/design_evaluator.hpp"
#include "app/sweep/evaluators/search_evaluator.hpp"
#include "optim/doe/nan.hpp"

namespace kinetix::app {
namespace {

void fail(SampleRow& row, const SweepPlan& plan, const std::string& why) {
  row.status = SampleStatus::failed;
  row.reason = why;
  row.responses.assign(plan.responses.size(), optim::nan);
}

}  // namespace

std::string to_string(SampleStatus status) {
  switch (status) {
    case SampleStatus::ok:
      return "ok";
    case SampleStatus::missed:
      return "missed";
    case SampleStatus::disagrees:
      return "disagrees";
    case SampleStatus::failed:
      break;
  }
  return "failed";
}

std::unique_ptr<Evaluator> make_evaluator(const SweepPlan& plan) {
  if (plan.searches()) return std::make_unique<SearchEvaluator>(plan);
  return std::make_unique<DesignEvaluator>(plan);
}

void take_verdict(const RunVerdict& verdict, SampleRow& row) {
  const ExitCode code = exit_code(verdict);
  row.status = code == target_missed       ? SampleStatus::missed
               : code == physics_disagrees ? SampleStatus::disagrees
                                           : SampleStatus::ok;
  row.reason = verdict.reasons();
}

SampleRow run_sample(const SweepPlan& plan, Evaluator& evaluator, std::int64_t sample) noexcept {
  SampleRow row;
  row.sample = sample;
  row.factors.resize(plan.samples.factors().size());
  row.responses.resize(plan.responses.size());
  plan.samples.sample(static_cast<std::uint64_t>(sample), row.factors);
  try {
    evaluator.evaluate(row);
  } catch (const InvalidInput& e) {
    fail(row, plan, (e.place().key.empty() ? "" : e.place().key + ": ") + e.reason());
  } catch (const std::bad_alloc&) {
    fail(row, plan, "there is not enough memory");
  } catch (const std::exception& e) {
    fail(row, plan, e.what());
  } catch (...) {
    fail(row, plan, "an unknown exception");
  }
  return row;
}

}  // namespace kinetix::app
