#pragma once

#include <cmath>
#include <optional>

#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/step_length.hpp"
#include "model/elastic/path/trial.hpp"

namespace kinetix::model {

/// What speaks against a step to a trial state.
struct StepFaults {
  double jump = NAN;       ///< of a hinge from the prediction, rad; NaN where no equilibrium was found
  bool jumped = false;     ///< that is too much for one branch, and no branch was chosen there
  bool tunnelled = false;  ///< walls went through each other
  bool mirrored = false;   ///< the sheet folded to the side that was not asked for
};

/// A step that may be taken.
struct PermittedStep {
  EquilibriumStep step;
  bool snapped = false;  ///< to another state at nearly the same drive, and some energy is lost
  bool touches = false;  ///< walls begin to touch or the last of them part
  bool bends = false;    ///< the load does not go on as it did
};

/// Whether a path may step to a trial state.
class StepCheck {
 public:
  /// @param system kept by reference  @param longest_jump of a hinge, rad
  StepCheck(const MeasuredSystem& system, double longest_jump)
      : system_(system), longest_jump_(longest_jump) {}

  /// None where the trial is no equilibrium. @param before the state that the path has come to
  StepFaults faults(const State& before, const State& prediction, const Trial& trial) const;
  /// Jumps to another state, and where contact begins or ends, are located first: only short steps go there.
  /// @param before that the path has come to  @pre the system's tangent is that of the trial
  std::optional<PermittedStep> permitted(const NextStep& next, const EquilibriumStep& before,
                                         const Trial& trial, const StepFaults& faults) const;
  /// Whether a step from the last state on a branch came to another one of less energy, there.
  bool loses_energy(const EquilibriumStep& before, const EquilibriumStep& after) const;

 private:
  /// Whether the energy changes by the work of the loads at both ends of a step: a jump between them loses
  /// some.
  bool keeps_energy(const EquilibriumStep& before, const EquilibriumStep& after) const;
  /// Whether the load changes by what its derivatives at both ends of a step make of it: where the path jumps or turns unstable it does not.
  static bool keeps_load(const EquilibriumStep& before, const EquilibriumStep& after);

  const MeasuredSystem& system_;
  const double longest_jump_;  ///< rad
};

}  // namespace kinetix::model
