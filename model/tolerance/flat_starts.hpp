#pragma once

#include <optional>

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/tolerance/print_equilibria.hpp"

namespace kinetix::model {

/// Outcome of sample prints that plates press from flat, the state in which they are printed. Plates select
/// no side, and the errors of a print need not select one either.
struct FlatStarts {
  int prints = 0;       ///< that reached the end of their drive
  int other_side = 0;   ///< of these, pushed by their errors to the side that is not requested
  int either_side = 0;  ///< of these, pushed to no side: chance decides
  int failed = 0;       ///< all others

  /// Returns whether some prints do not fold to the requested side without help.
  bool need_help() const { return other_side + either_side > 0; }
};

/// Traces the path of each print to both sides. If errors push a print, both paths end on one side, that of
/// the mean turn of its hinges (mean_theta()). Without a push, each path leaves flat by a bifurcation to its
/// side.
/// @param drive plates
/// @param count > 0
/// @param options only seed, planar, threads and stop have an effect.
/// @param path options of the path of each print
/// @return empty if options.stop ends the run before the last print
std::optional<FlatStarts> flat_starts(const PrintedLinkage& printed, const Elasticity& elasticity,
                                      const LinkageDrive& drive, const HingeScatter& scatter, int count,
                                      const ToleranceOptions& options, EquilibriumPathOptions path = {});

}  // namespace kinetix::model
