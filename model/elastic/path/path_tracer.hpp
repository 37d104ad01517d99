#pragma once

#include "model/elastic/path/path_record.hpp"
#include "model/elastic/path/retrace.hpp"
#include "model/elastic/path/step_check.hpp"
#include "model/elastic/path/step_length.hpp"
#include "model/elastic/path/step_solver.hpp"

namespace kinetix::model {

/// Traces an equilibrium path from flat: each step is predicted, solved for and checked, and the next one is
/// as long as that went well. Where walls begin to touch or part, where the path jumps or turns unstable, and where
/// it ends is located by bisection. Steps and events do not depend on the goal: the last step alone ends there.
/// See trace_equilibrium for the parameters and the result.
class PathTracer {
 public:
  /// All parameters are kept by reference.
  PathTracer(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options,
             const std::function<void(const EquilibriumStep&, const State&)>& frame);

  /// Once.
  EquilibriumPath run();

 private:
  /// A step that was tried.
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
  /// Settles a rough head to the last digit, so that its error does not look like an event behind it.
  /// @return whether the head has moved
  bool settle_head();
  /// Whether a step may be taken and nothing happens on it that has a place of its own on the path.
  bool is_plain(const Attempt& attempt) const;
  /// Moves the head to just before what happens on a short step, and takes the step behind it.
  Outcome take_event(Attempt event);
  /// The shortest attempt that is found from the head at which something happens; the head moves up to just before it.
  Attempt locate(Attempt event);
  /// Tries short steps from a head that no plain step leaves.
  Outcome land(bool located);
  /// Goes back from behind a jump: it is a snap if the way back ends in another state of other energy.
  /// @param located as of Arrival   @param multiplier of the head   @return false where it leads to the side that was not asked for
  bool look_back(Attempt& landed, bool located, double multiplier);
  /// @param located as of Arrival
  void take(Attempt attempt, bool located = false);
  void refuse(const Attempt& attempt);
  /// Goes back to the head after an attempt that was not taken.
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
  Refusal refusal_;     ///< of the last step that was not taken
  EquilibriumStep at_;  ///< of the head
  bool is_settled_ =
      true;  ///< the head is an equilibrium to the last digit, not to what steps before the goal ask for
  const EquilibriumPathOptions& options_;
};

}  // namespace kinetix::model
