#pragma once

#include <optional>

#include "model/elastic/elastic_system.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// Ways down from an equilibrium that is no minimum.
class Branch {
 public:
  /// @param exact the closed form of the system's linkage, where there is one; kept by reference
  /// @param goal fold parameter that the drive goes to, rad  @param side +1 or -1: which way where neither
  /// the exact mode nor the sign of the drive tells
  Branch(const ElasticSystem& system, const ExactMotion& exact, double goal, int side);

  enum class Way {
    exact,        ///< on the closed form of an exact family
    off_exact,    ///< from there on along the lowest mode: the closed form is unstable too
    lowest_mode,  ///< along the lowest mode
    none,         ///< that is neutral: nowhere to go
    unknown,      ///< it was not found
  };
  struct Start {
    Way way = Way::unknown;
    State state;
  };
  /// Where to start down from the equilibrium `from` at theta, rad: the state of the exact family where the
  /// structure belongs to one and it lies lower, else a step along the lowest mode, with the sign that turns
  /// class A as the drive does where it turns the checkerboard at all; a valley that bends away from the
  /// step's line is met 0.05 rad or cell edges on. A long strip folds between its plates under a load that
  /// may be more than it bears without tipping over: a closed form that is no minimum is left at once, along
  /// the lowest mode from there. @param tangent of `from`; afterwards of no use
  Start leave(double theta, const State& from, TangentStiffness& tangent) const;
  /// The closed form at theta, rad, of a structure that belongs to an exact family, where the drive holds it.
  std::optional<State> exact_state(double theta) const;

 private:
  Start onto_exact(double theta, const State& exact, TangentStiffness& tangent) const;
  /// @param is_folded the sign of the drive is taken: the side is left open
  Start along_lowest_mode(double theta, const State& from, TangentStiffness& tangent,
                          bool is_folded = false) const;
  State relaxed(double theta, const State& exact, TangentStiffness& tangent) const;
  State downhill(double theta, const State& from, const Eigen::VectorXd& along) const;
  double drive_side(const Eigen::VectorXd& all) const;
  double option_side(const Eigen::VectorXd& all) const;

  const ElasticSystem& system_;
  const ExactMotion& exact_;
  double goal_;
  int side_;
};

}  // namespace kinetix::model
