#pragma once

#include "model/elastic/path/path_record.hpp"
#include "model/elastic/path/retrace.hpp"
#include "model/elastic/path/step_check.hpp"
#include "model/elastic/path/step_length.hpp"
#include "model/elastic/path/step_solver.hpp"

namespace kinetix::model {

/// Traces an equilibrium path from flat: each step is predicted, solved for and checked, and the next one is
/// as long as that went well. See trace_equilibrium for what it takes and gives.
class PathTracer {
 public:
  /// All parameters are kept by reference.
  PathTracer(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options,
             const std::function<void(const EquilibriumStep&, const State&)>& frame);

  /// Once.
  EquilibriumPath run();

 private:
  /// One step. @return whether it was taken
  bool advance(const NextStep& next);
  /// Goes back from where a step jumped, left a branch or met a state that is no minimum: it snapped if the way back ends in
  /// another state of other energy. @param multiplier of the head   @return whether the step may still be taken
  bool look_back(const NextStep& next, const Trial& trial, double multiplier, PermittedStep& permitted,
                 StepFaults& faults);
  void take(Trial trial, const PermittedStep& permitted, double jump);
  void refuse(const NextStep& next, const Trial& trial, const StepFaults& faults);

  MeasuredSystem system_;
  const ClosedForm closed_form_;
  PathHead head_;
  StepSolver solver_;
  const StepCheck check_;
  StepLength length_;
  PathRecord record_;
  Retrace retrace_;
  std::stop_token stop_;
  Refusal refusal_;  ///< of the last step that was not taken
};

}  // namespace kinetix::model
