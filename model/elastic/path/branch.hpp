#pragma once

#include "model/elastic/newton.hpp"
#include "model/elastic/path/closed_form.hpp"

namespace kinetix::model {

/// Continuation of a path from an equilibrium that is not a minimum.
class Branch {
 public:
  /// @param closed_form of the system; both are kept by reference
  /// @param side +1 or -1: sign of the lowest mode if the drive's sign does not define it
  Branch(const ElasticSystem& system, const ClosedForm& closed_form, int side)
      : system_(system), closed_form_(closed_form), side_(side) {}

  /// Direction of the descent in energy.
  enum class Descent {
    closed_form,      ///< onto the closed form
    off_closed_form,  ///< along the lowest mode of the closed form, which is unstable too
    lowest_mode,      ///< along the lowest mode
    none,             ///< the lowest mode is neutral: there is no descent
    unknown,          ///< the lowest mode was not found
  };
  struct Start {
    Descent descent = Descent::unknown;
    State state;
  };
  /// Returns the start of a descent from the equilibrium `from` at theta, rad. If there is a closed form with
  /// less energy, the start is there. Otherwise it is a step along the lowest mode. Its sign turns class A as
  /// the drive does, if the mode turns the checkerboard at all. If the valley curves away from the line of
  /// the step, the start is 0.05 rad or cell edges along it.
  ///
  /// Between plates, a long strip may fold under a load that exceeds its stability against tipping over. So a
  /// closed form that is not a minimum is left at once along its lowest mode, to `side`.
  /// @param tangent linearised at `from`; not usable afterwards
  Start leave(double theta, const State& from, TangentStiffness& tangent) const;

  /// Returns 1 if `along`, twists of all bodies, points to the side that leave() takes, otherwise -1.
  double side_of(const Eigen::VectorXd& along) const;

 private:
  Start onto_closed_form(double theta, const State& exact, TangentStiffness& tangent) const;
  /// @param is_folded the drive's sign is already used: `side` decides
  Start along_lowest_mode(double theta, const State& from, TangentStiffness& tangent, bool is_folded) const;

  const ElasticSystem& system_;
  const ClosedForm& closed_form_;
  const int side_;
};

/// Final state of a search for the next equilibrium of a path.
struct Trial {
  double theta = 0;  ///< rad
  State state;       ///< in equilibrium if newton.converged
  NewtonResult newton;
  int iterations = 0;  ///< of all searches
  /// Last change of branch: how an unstable equilibrium was left to reach the state, if one was.
  std::optional<Branch::Descent> descent;
  bool mirrored = false;  ///< in equilibrium on the side that was not requested (ClosedForm)
};

}  // namespace kinetix::model
