#pragma once

#include "model/elastic/path/path_head.hpp"
#include "model/elastic/path/step_length.hpp"

namespace kinetix::model {

/// Finds the equilibrium that a path may step to.
class StepSolver {
 public:
  /// All parameters are kept by reference.
  StepSolver(MeasuredSystem& system, const ClosedForm& closed_form, const EquilibriumPathOptions& options)
      : system_(system),
        closed_form_(closed_form),
        branch_(system.elastic, closed_form, options.side),
        options_(options) {}

  /// Searches from a prediction by Newton's method. Behind a bifurcation it takes the branch to the drive's side. From an
  /// equilibrium that is no minimum it goes down, and from one on the other side it goes back to the last state of the path and
  /// down from there. The system's tangent is then that of the trial, if that is stable.
  Trial find(const NextStep& next, const PathHead& head, const State& prediction);

 private:
  /// @param may_stray far from the prediction
  NewtonOptions newton_options(const NextStep& next, bool may_stray) const;
  /// The same with less patience where a shorter step may still be tried.
  NewtonOptions first_options(const NextStep& next) const;
  void search(const NewtonOptions& options, bool factorised, Trial& trial);
  bool is_mirrored(const Trial& trial) const;
  /// From the last state of the path, carried on to theta, down to the side of the drive. Flat between plates
  /// bears no load that counts beside rounding where hinges turn softly, and hardly any elsewhere: minimising
  /// the energy from there may leave the side to chance. @return whether that state was unstable, and left
  bool leave_head(const NextStep& next, const PathHead& head, Trial& trial);
  /// Searches again from the closed form. The first search may have crept along a valley of a floppy sheet.
  void search_from_closed_form(const NextStep& next, const PathHead& head, Trial& trial);
  /// Looks for the other branch behind a bifurcation, since a search ends on either one by chance. A path from between the two
  /// takes the branch to the drive's side, a descent. A path on one of two images stays there.
  void choose_side(const NextStep& next, const PathHead& head, const State& prediction, Trial& trial);
  /// Finds the equilibrium to the last digit, where Newton's method comes so far. @return whether it is stable
  bool polish(Trial& trial);
  /// To the last digit. @return whether it ended in a stable equilibrium
  bool search_from(State start, Trial& trial);
  /// Whether two minima at one theta are different states, and whether of the same energy, too.
  bool differ(const Trial& one, const Trial& other) const;
  bool are_twins(const Trial& one, const Trial& other) const;
  /// From an equilibrium that is no minimum down to one that is, over further saddles if need be; where that
  /// fails, there is no equilibrium to take. It stays where its lowest mode is neutral.
  void leave_saddles(const NextStep& next, Trial& trial);

  MeasuredSystem& system_;
  const ClosedForm& closed_form_;
  const Branch branch_;
  const EquilibriumPathOptions& options_;
};

}  // namespace kinetix::model
