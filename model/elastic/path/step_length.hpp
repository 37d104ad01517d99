#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

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

}  // namespace kinetix::model
