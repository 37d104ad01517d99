#pragma once

#include "model/elastic/path/path_record.hpp"
#include "model/elastic/path/retrace.hpp"
#include "model/elastic/path/step_check.hpp"
#include "model/elastic/path/step_length.hpp"
#include "model/elastic/path/step_solver.hpp"

namespace kinetix::model {

/// Tracer of an equilibrium path from flat. Each step is predicted, solved for and checked, and its success
/// sets the length of the next one. Bisection locates begin and end of contact, jumps, instabilities and the
/// end of the path. Except for the last step, which ends at the goal, steps and events do not depend on the
/// goal. See trace_equilibrium() for the parameters and the result.
class PathTracer {
 public:
  /// All parameters are kept by reference.
  PathTracer(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options,
             const std::function<void(const EquilibriumStep&, const State&)>& frame);

  /// Traces the path. Call it once.
  EquilibriumPath run();

 private:
  /// Attempted step.
  struct Attempt {
    NextStep next;
    Trial trial;
    StepFaults faults;
    std::optional<PermittedStep> permitted;
    int order = 1;  ///< of the prediction
  };
  enum class Outcome { taken, refused, ended };

  Outcome advance(const NextStep& next);
  Attempt attempt(const NextStep& next);
  /// Settles a roughly converged head to full accuracy, so that its error does not look like an event after
  /// it.
  /// @return whether the head has moved
  bool settle_head();
  /// Returns whether a step may be taken without an event on it that must be located.
  bool is_plain(const Attempt& attempt) const;
  /// Moves the head to just before the event on a short step, and takes the step after it.
  Outcome take_event(Attempt event);
  /// Bisects for an event. @return the shortest attempt from the head with the event; the head moves to just
  /// before it
  Attempt locate(Attempt event);
  /// Tries short steps from a head that no plain step can leave.
  Outcome land(bool located);
  /// Traces back from behind a jump. It is a snap-through if this ends in another state of other energy.
  /// @param located as in Arrival
  /// @param multiplier of the head
  /// @return false if the jump leads to the side that is not requested
  bool look_back(Attempt& landed, bool located, double multiplier);
  /// @param located as in Arrival
  void take(Attempt attempt, bool located = false);
  void refuse(const Attempt& attempt);
  /// Returns to the head after a refused attempt.
  void go_back(double multiplier);

  MeasuredSystem system_;
  const ClosedForm closed_form_;
  PathHead head_;
  StepSolver solver_;
  const StepCheck check_;
  StepLength length_;
  PathRecord record_;
  Retrace retrace_;
  std::stop_token stop_;
  Refusal refusal_;     ///< of the last refused step
  EquilibriumStep at_;  ///< of the head
  /// Whether the head is converged to full accuracy, not only to the tolerance of steps before the goal.
  bool is_settled_ = true;
  const EquilibriumPathOptions& options_;
};

}  // namespace kinetix::model
