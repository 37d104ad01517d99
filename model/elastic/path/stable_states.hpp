#pragma once

#include <string>
#include <vector>

#include "model/elastic/path/turning_points.hpp"

namespace kinetix::model {

/// A state that a structure keeps with nothing driving it: the tangent of its energy is positive definite.
struct StableState {
  State state;        ///< mm
  double energy = 0;  ///< N mm
  double theta = 0;   ///< mean fold parameter of the upright hinges (of all where none is), rad
  HingeGaps gaps;
  std::string how;  ///< in words: what led there
};

struct StableStates {
  std::vector<StableState>
      states;  ///< flat first; in each, a hinge's turn is 1e-3 rad from that in any other
  std::vector<EnergyBarrier> barriers;  ///< at most one for a pair, the lowest that was met
  std::vector<std::string> unresolved;  ///< releases that reached no stable state, in words
};

struct StableStateOptions {
  EquilibriumPathOptions path;
  int max_iterations = 400;  ///< of Newton's method after a release
};

/// Where the energy of a path that a drive took to its goal still falls there, follows the same path beyond the goal to where it
/// stops falling, for stable_states() to release the structure there: EnergyTurns::set_foot. So a state does not depend on how far
/// the drive went. Does nothing for other paths, plates that press and shape memory.
/// @param options those of the path
void follow_fall(const DrivenLinkage& driven, const Elasticity& elasticity,
                 const EquilibriumPathOptions& options, EnergyTurns& path);

/// The stable states that driven paths of trace_equilibrium lead to, made with the same structure, elasticity
/// and options: flat, and where the structure goes when it is released from each minimum of the energy along
/// a path and from an end that it still falls to (from EnergyTurns::foot, if that is known). Further ones may exist that no path comes near. Where options.path.stop
/// asks to, those found so far.
StableStates stable_states(const Linkage& structure, const Elasticity& elasticity,
                           const std::vector<EnergyTurns>& paths, const StableStateOptions& options = {});

/// The same after tracing the paths of these drives from flat.
/// @throws InvalidInput for options, stiffnesses or drives out of range
/// @pre at least one drive, all of one linkage
StableStates find_stable_states(const std::vector<DrivenLinkage>& drives, const Elasticity& elasticity,
                                const StableStateOptions& options = {});

}  // namespace kinetix::model
