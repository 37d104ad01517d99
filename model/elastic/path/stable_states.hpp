#pragma once

#include "model/elastic/path/turning_points.hpp"

namespace kinetix::model {

/// Stable state of a structure without a drive: the tangent of its energy is positive definite.
struct StableState {
  State state;        ///< mm
  double energy = 0;  ///< N mm
  double theta = 0;   ///< mean fold parameter of the vertical hinges (of all if none is vertical), rad
  HingeGaps gaps;
  std::string how;  ///< description of how it was found
};

struct StableStates {
  /// Flat first. Any two states differ by more than 1e-3 rad in a hinge's turn.
  std::vector<StableState> states;
  std::vector<EnergyBarrier> barriers;  ///< at most one per pair of states, the lowest that was found
  std::vector<std::string> unresolved;  ///< descriptions of releases that reached no stable state
};

struct StableStateOptions {
  EquilibriumPathOptions path;
  int max_iterations = 400;  ///< of Newton's method after a release
};

/// Extends a path whose energy still falls at the drive's goal. The extension follows the path beyond the
/// goal until the energy stops falling, and stores that state by EnergyTurns::set_foot. stable_states() then
/// releases the structure there, so that a state does not depend on the drive's goal. Does nothing for other
/// paths, plates that press and shape memory.
/// @param options those of the path
void follow_descent(const DrivenLinkage& driven, const Elasticity& elasticity,
                    const EquilibriumPathOptions& options, EnergyTurns& path);

/// Finds stable states with driven paths of trace_equilibrium(), made with the same structure, elasticity and
/// options. The result has flat, and the states after releases at each energy minimum along a path. If the
/// energy falls at the end of a path, the structure is also released there (or at EnergyTurns::foot, if
/// known). More states may exist that no path approaches. If options.path.stop requests it, the result has
/// those found so far.
StableStates stable_states(const Linkage& structure, const Elasticity& elasticity,
                           const std::vector<EnergyTurns>& paths, const StableStateOptions& options = {});

/// Traces the paths of these drives from flat and finds the stable states.
/// @throws InvalidInput for options, stiffnesses or drives out of range
/// @pre at least one drive, all of one linkage
StableStates find_stable_states(const std::vector<DrivenLinkage>& drives, const Elasticity& elasticity,
                                const StableStateOptions& options = {});

}  // namespace kinetix::model
