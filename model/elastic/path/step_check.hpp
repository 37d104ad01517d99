#pragma once

#include <cmath>
#include <optional>

#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/step_length.hpp"
#include "model/elastic/path/trial.hpp"

namespace kinetix::model {

/// Reasons to refuse a step to a trial state.
struct StepFaults {
  double jump = NAN;       ///< of a hinge from the prediction, rad; NaN if no equilibrium was found
  bool jumped = false;     ///< the jump is too long for one branch, and no branch was chosen there
  bool tunnelled = false;  ///< walls passed through each other
  bool mirrored = false;   ///< the sheet folded to the side that was not requested
};

/// Step that may be taken.
struct PermittedStep {
  EquilibriumStep step;
  bool snapped = false;  ///< to another state at nearly the same drive, with loss of energy
  bool touches = false;  ///< walls begin to touch, or the last contact ends
  bool bends = false;    ///< the load does not continue smoothly
};

/// Check of whether a path may step to a trial state.
class StepCheck {
 public:
  /// @param system kept by reference   @param longest_jump limit for a hinge, rad
  StepCheck(const MeasuredSystem& system, double longest_jump)
      : system_(system), longest_jump_(longest_jump) {}

  /// Returns the faults of a trial; none if it is not an equilibrium. @param before present state of the path
  StepFaults faults(const State& before, const State& prediction, const Trial& trial) const;
  /// Returns the step if it is permitted. Jumps to another state, and begin and end of contact, must be
  /// located first, so that only short steps cross them.
  /// @param before present step of the path   @pre the system's tangent is that of the trial
  std::optional<PermittedStep> permitted(const NextStep& next, const EquilibriumStep& before,
                                         const Trial& trial, const StepFaults& faults) const;
  /// Returns whether a step from the last state of a branch leads to another branch with less energy there.
  bool loses_energy(const EquilibriumStep& before, const EquilibriumStep& after) const;

 private:
  /// Returns whether the energy changes by the work of the loads at both ends of a step. A jump between them
  /// loses some.
  bool keeps_energy(const EquilibriumStep& before, const EquilibriumStep& after) const;
  /// Returns whether the load changes as predicted by its derivatives at both ends of a step. It does not if
  /// the path jumps or turns unstable.
  static bool keeps_load(const EquilibriumStep& before, const EquilibriumStep& after);

  const MeasuredSystem& system_;
  const double longest_jump_;  ///< rad
};

}  // namespace kinetix::model
