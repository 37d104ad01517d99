#pragma once

#include "model/elastic/path/branch.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/elastic/path/measured_system.hpp"
#include "model/elastic/path/path_head.hpp"

namespace kinetix::model {

/// Next step to try on a path.
struct NextStep {
  double theta = 0;   ///< rad
  double length = 0;  ///< of the step, rad
  bool to_goal = false;
  bool is_short = false;     ///< so short that jumps to another state and begin of contact are permitted
  bool is_shortest = false;  ///< no shorter step will be tried
  bool locates = false;      ///< bisection for an event: the step is not taken if it has one
  /// Starts at an event. The tangent there is nearly singular, so the prediction does not use it.
  bool leaves = false;
};

/// Adaptive steps of theta, based on prediction errors. Except for the last one, which ends at the goal, they
/// do not depend on the goal.
class StepLength {
 public:
  /// @param goal theta, rad   @param options kept by reference
  StepLength(const EquilibriumPathOptions& options, double goal);

  NextStep next(double from) const;
  /// Returns the next step as if the goal were further away, that is, the step of a longer path from here.
  NextStep next_beyond(double from) const;
  /// Returns a step of given length towards the goal, at most to it, and marked short so that a jump is
  /// taken.
  NextStep landing(double from, double length) const;
  /// Returns the factor for the next step that keeps a hinge's turn beyond the prediction below longest_jump.
  /// @param jump that turn at the present step, rad; NaN if unknown
  /// @param order of the prediction: its error scales with the step to the power of order + 1
  double growth(double jump, int order) const;
  /// Adapts the length after a step was taken. @param touching whether walls touch at its end
  void change(double growth, bool touching);
  /// Shortens the length after a refused step, to at most half of that step.
  void shorten(const NextStep& refused, double growth);

 private:
  const EquilibriumPathOptions& options_;
  NextStep to(double theta, double from) const;

  const double goal_;
  double step_;  ///< rad, > 0
};

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

/// Solver for the next equilibrium of a path.
class StepSolver {
 public:
  /// All parameters are kept by reference.
  StepSolver(MeasuredSystem& system, const ClosedForm& closed_form, const EquilibriumPathOptions& options)
      : system_(system),
        closed_form_(closed_form),
        branch_(system.elastic, closed_form, options.side),
        options_(options) {}

  /// Searches from a prediction by Newton's method. After a bifurcation it takes the branch to the drive's
  /// side. From an equilibrium that is not a minimum it descends. From one on the other side it returns to
  /// the last state of the path and descends from there. Afterwards the system's tangent is that of the
  /// trial, if the trial is stable.
  Trial find(const NextStep& next, const PathHead& head, const State& prediction);

 private:
  /// @param may_leave_branch whether the search may move far from the prediction
  NewtonOptions newton_options(const NextStep& next, bool may_leave_branch) const;
  /// Returns options with fewer iterations if a shorter step may still be tried.
  NewtonOptions first_options(const NextStep& next) const;
  void search(const NewtonOptions& options, bool factorised, Trial& trial);
  bool is_mirrored(const Trial& trial) const;
  /// Descends to the drive's side from the last state of the path, moved to theta. Flat between plates has
  /// almost no load, and none above rounding if hinges turn softly. So minimising the energy from flat may
  /// reach either side by chance.
  /// @return whether that state was unstable, and was left
  bool leave_head(const NextStep& next, const PathHead& head, Trial& trial);
  /// Searches again from the closed form. The first search may be stuck in a valley of an underconstrained
  /// sheet.
  void search_from_closed_form(const NextStep& next, const PathHead& head, Trial& trial);
  /// Looks for the other branch after a bifurcation, since a search ends on either one by chance. A path
  /// between the two takes the branch to the drive's side, by a descent. A path on one of two mirror images
  /// stays there.
  void choose_side(const NextStep& next, const PathHead& head, const State& prediction, Trial& trial);
  /// Solves the equilibrium to full accuracy, if Newton's method converges that far. @return whether it is
  /// stable
  bool polish(Trial& trial);
  /// Searches to full accuracy. @return whether it ended in a stable equilibrium
  bool search_from(State start, Trial& trial);
  /// Returns whether two minima at one theta are different states.
  bool differ(const Trial& one, const Trial& other) const;
  /// Returns whether two minima at one theta are different states of the same energy.
  bool are_twins(const Trial& one, const Trial& other) const;
  /// Descends from an equilibrium that is not a minimum to one that is, over several saddles if needed. If
  /// this fails, there is no equilibrium to take. A state with a neutral lowest mode is kept.
  void leave_saddles(const NextStep& next, Trial& trial);

  MeasuredSystem& system_;
  const ClosedForm& closed_form_;
  const Branch branch_;
  const EquilibriumPathOptions& options_;
};

}  // namespace kinetix::model
