#pragma once

#include <functional>
#include <optional>

#include "model/tolerance/print_equilibria.hpp"

namespace kinetix::model {

/// A state on the way from flat to a fold, and what holds it there.
struct HeldState {
  State state;  ///< in equilibrium or nearly so
  Elasticity elasticity;
  LinkageDrive drive;
};

/// Sample prints, and those of them whose walls touch.
struct TouchingPrints {
  int prints = 0;
  int touching = 0;

  /// @pre prints > 0
  double share() const { return static_cast<double>(touching) / prints; }
};

/// Counts prints with errors whose walls touch in any of the states that a design passes. Errors add up along the sheet: two
/// bodies that no hinge joins miss each other by the scatter of one against the other, which may be many times the error of a
/// hinge. Each print has its own walls and its own equilibrium; plates of two bodies touch where their boxes overlap, and what
/// WallContact leaves out is left out here. First order alone shows in which prints that has to be looked at: ends of a long
/// strip move by so much that it is wrong about one in three of those that it lets touch.
///
/// Only plates that come closer in the design than their scatter allows are looked at, each two in the state in which they come
/// closest against that scatter. Prints are counted until the standard error of the share is below 0.016, 1000 at most. The
/// same seed gives the same prints.
///
/// @param states > 0   @param way state k of the design, the last one its fold; nothing: left out
/// @param options planar, seed, threads and stop have an effect
/// @return nothing where no state is in stable equilibrium, and where it is told to stop before the first prints
std::optional<TouchingPrints> touching_prints(const PrintedLinkage& printed, int states,
                                              const std::function<std::optional<HeldState>(int)>& way,
                                              const HingeScatter& scatter, const AsMadeOptions& options = {});

}  // namespace kinetix::model
