#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// Where a path tries to go next.
struct NextStep {
  double theta = 0;   ///< rad
  double length = 0;  ///< of the step, rad
  bool to_goal = false;
  bool is_short = false;     ///< so short that a jump to another state is taken, and walls may begin to touch
  bool is_shortest = false;  ///< no shorter one will be tried
  bool locates = false;      ///< looks for where something happens: the step is not taken if anything does
  bool leaves =
      false;  ///< starts where something happens: the tangent there is nearly singular, so that a prediction along it is no use
};

/// Steps of theta that adapt to how well they are predicted. They do not depend on the goal, except the last one, which ends there.
class StepLength {
 public:
  /// @param goal theta, rad  @param options are kept by reference
  StepLength(const EquilibriumPathOptions& options, double goal);

  NextStep next(double from) const;
  /// The same if the goal were further away: what a longer path would try from here.
  NextStep next_beyond(double from) const;
  /// Of a given length towards the goal and not beyond it, short enough for a jump to be taken.
  NextStep landing(double from, double length) const;
  /// Factor for the next step so that a hinge will turn by less than longest_jump beyond the prediction.
  /// @param jump by what it did now, rad; NaN where that is not known  @param order of the prediction: its
  /// error grows with the step to one power more
  double growth(double jump, int order) const;
  /// After a step that was taken. @param touching walls touch behind it
  void change(double growth, bool touching);
  /// After one that was not: to a half of it at most.
  void shorten(const NextStep& refused, double growth);

 private:
  const EquilibriumPathOptions& options_;
  NextStep to(double theta, double from) const;

  const double goal_;
  double step_;  ///< rad, > 0
};

}  // namespace kinetix::model
