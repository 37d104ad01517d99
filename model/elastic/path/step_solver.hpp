#pragma once

#include "model/elastic/path/path_head.hpp"
#include "model/elastic/path/step_length.hpp"

namespace kinetix::model {

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
  /// @param may_stray whether the search may move far from the prediction
  NewtonOptions newton_options(const NextStep& next, bool may_stray) const;
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
