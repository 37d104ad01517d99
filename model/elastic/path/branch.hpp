#pragma once

#include "model/elastic/path/closed_form.hpp"

namespace kinetix::model {

/// Where a path goes on from an equilibrium that is no minimum.
class Branch {
 public:
  /// @param closed_form of the system; both are kept by reference
  /// @param side +1 or -1: the sign of the lowest mode where the drive's sign does not tell it
  Branch(const ElasticSystem& system, const ClosedForm& closed_form, int side)
      : system_(system), closed_form_(closed_form), side_(side) {}

  /// Direction in which the energy is left to fall.
  enum class Descent {
    closed_form,      ///< onto the closed form
    off_closed_form,  ///< from there on along the lowest mode: the closed form is unstable too
    lowest_mode,      ///< along the lowest mode
    none,             ///< that is neutral: nowhere to go
    unknown,          ///< it was not found
  };
  struct Start {
    Descent descent = Descent::unknown;
    State state;
  };
  /// Where to start down from the equilibrium `from` at theta, rad: on the closed form where there is one and
  /// it lies lower, else a step along the lowest mode, with the sign that turns class A as the drive does
  /// where it turns the checkerboard at all; a valley that bends away from the step's line is met 0.05 rad or
  /// cell edges on. A long strip folds between its plates under a load that may be more than it bears without
  /// tipping over: a closed form that is no minimum is left at once, along the lowest mode from there, to
  /// `side`. @param tangent of `from`, just linearised; afterwards of no use
  Start leave(double theta, const State& from, TangentStiffness& tangent) const;

  /// 1 where `along`, twists of all bodies, leads to the side that leave() takes, -1 where it leads to the other one.
  double side_of(const Eigen::VectorXd& along) const;

 private:
  Start onto_closed_form(double theta, const State& exact, TangentStiffness& tangent) const;
  /// @param is_folded the sign of the drive is taken: `side` decides
  Start along_lowest_mode(double theta, const State& from, TangentStiffness& tangent, bool is_folded) const;

  const ElasticSystem& system_;
  const ClosedForm& closed_form_;
  const int side_;
};

}  // namespace kinetix::model
