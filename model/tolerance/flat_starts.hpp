#pragma once

#include <optional>

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/tolerance/print_equilibria.hpp"

namespace kinetix::model {

/// Sample prints that plates press from flat, as they are printed. Plates push to neither side, and errors of a print need not either.
struct FlatStarts {
  int prints = 0;       ///< that came to the end of their drive
  int other_side = 0;   ///< of these, pushed to the other side than the drive asks for, by their errors
  int either_side = 0;  ///< of these, pushed to no side: chance decides
  int failed = 0;       ///< all others

  /// Prints that do not fold as asked for by themselves.
  bool need_help() const { return other_side + either_side > 0; }
};

/// Traces the path of each print to both sides. Errors that push a print lead both paths to one side, that of the mean turn of its
/// hinges (mean_theta); without a push each path leaves flat by a bifurcation to its own side.
/// @param drive plates
/// @param count > 0   @param options seed, planar, threads and stop have an effect   @param path of each print
/// @return nothing where it is told to stop before the last print
std::optional<FlatStarts> flat_starts(const PrintedLinkage& printed, const Elasticity& elasticity,
                                      const LinkageDrive& drive, const HingeScatter& scatter, int count,
                                      const AsMadeOptions& options, EquilibriumPathOptions path = {});

}  // namespace kinetix::model
