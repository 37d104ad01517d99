#pragma once

#include "model/tolerance/print_equilibria.hpp"

namespace kinetix::model {

/// Path of a design from flat to its fold.
struct MotionPath {
  int states = 0;                                   ///< before the fold
  std::function<std::optional<HeldState>(int)> at;  ///< first is 0; empty: skipped
};

/// Counts of sample prints whose walls touch.
struct TouchingPrints {
  int prints = 0;    ///< checked to first order
  int touching = 0;  ///< that touch to first order
  int settled = 0;   ///< number of first prints that are also checked in equilibrium
  int gained = 0;    ///< of those, that touch in equilibrium only
  int lost = 0;      ///< of those, that touch to first order only

  /// Returns the share of prints that touch in equilibrium: the first-order share, corrected by gained and
  /// lost. @pre prints > 0
  double share() const;
  /// Returns the standard error of share().
  double error() const;
};

/// Counts prints with errors whose walls touch in any state on the path of a design. Errors add up along the
/// sheet. Two bodies without a common hinge are displaced by their relative scatter, which may be many times
/// the error of a hinge. Each print has its own walls and its own equilibrium. Plates of two bodies touch if
/// their boxes overlap; pairs that WallContact leaves out are left out here.
///
/// First order alone counts too many prints. Ends of a long strip move so far that it is wrong about one in
/// three prints that it counts as touching. So the first prints are also checked in equilibrium if needed, up
/// to a limit of work.
///
/// Only plates that are closer in the design than their scatter allows are checked. Each pair is checked in
/// the state in which it is closest relative to its scatter. Prints are counted until the standard error of
/// the first-order share is below 0.016 or 5 % of it (10 % for large sheets), 1000 at most. The same seed
/// gives the same prints.
///
/// @param options its planar, most_settled, seed, threads and stop are used
/// @return empty if the fold is not stable, or if options.stop ends the run before the first prints
std::optional<TouchingPrints> touching_prints(const PrintedLinkage& printed, const SettledDesign& fold,
                                              const MotionPath& motion, const HingeScatter& scatter,
                                              const ToleranceOptions& options = {});

}  // namespace kinetix::model
