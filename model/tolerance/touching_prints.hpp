#pragma once

#include <functional>
#include <optional>

#include "model/tolerance/print_equilibria.hpp"
#include "model/tolerance/settled_design.hpp"

namespace kinetix::model {

/// What a design passes on its way from flat to its fold.
struct WayToFold {
  int states = 0;                                   ///< before the fold
  std::function<std::optional<HeldState>(int)> at;  ///< 0 the first; nothing: left out
};

/// Sample prints, and those of them whose walls touch.
struct TouchingPrints {
  int prints = 0;    ///< looked at to first order
  int touching = 0;  ///< that touch to first order
  int settled = 0;   ///< the first of them, of which is known what they do in their equilibrium
  int gained = 0;    ///< of those, that touch in their equilibrium alone
  int lost = 0;      ///< that do so to first order alone

  /// That touch in their equilibrium: as to first order, and what equilibria change in those of which it is known. @pre prints > 0
  double share() const;
  /// Standard error of it.
  double error() const;
};

/// Counts prints with errors whose walls touch in any of the states that a design passes. Errors add up along the sheet: two
/// bodies that no hinge joins miss each other by the scatter of one against the other, which may be many times the error of a
/// hinge. Each print has its own walls and its own equilibrium; plates of two bodies touch where their boxes overlap, and what
/// WallContact leaves out is left out here. To first order alone too many touch: ends of a long strip move so far that it is wrong
/// about one in three of those that it lets touch.
///
/// Only plates that come closer in the design than their scatter allows are looked at, each two in the state in which they come
/// closest against that scatter. All prints are looked at to first order; the first of them also in their equilibrium where that
/// is needed, up to a limit of work. Prints are counted until the standard error of the share to first order is below 0.016 or
/// 5 % of it (10 % on large sheets), 1000 at most. The same seed gives the same prints.
///
/// @param options planar, seed, threads and stop have an effect
/// @return nothing where the fold is not stable, and where it is told to stop before the first prints
std::optional<TouchingPrints> touching_prints(const PrintedLinkage& printed, const SettledDesign& fold,
                                              const WayToFold& way, const HingeScatter& scatter,
                                              const AsMadeOptions& options = {});

}  // namespace kinetix::model
