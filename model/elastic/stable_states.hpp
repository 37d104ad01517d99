#pragma once

#include <string>
#include <vector>

#include "model/elastic/energy_summit.hpp"

namespace kinetix {

/// A state that a structure keeps with nothing driving it: the tangent of its energy is positive definite.
struct StableState {
  State state;        ///< mm
  double energy = 0;  ///< N mm
  double theta = 0;   ///< mean fold parameter of the upright hinges (of all where none is), rad
  HingeGaps gaps;
  std::string how;  ///< in words: which way led there
};

struct StableStates {
  std::vector<StableState>
      states;  ///< flat first; in each, a hinge's turn is 1e-3 rad from that in any other
  std::vector<EnergyBarrier> barriers;  ///< at most one for a pair, the lowest that was met
  std::vector<std::string> unresolved;  ///< releases that reached no stable state, in words
};

struct StableStateOptions {
  LoadPathOptions path;
  int max_iterations = 400;  ///< of Newton's method after a release
};

/// The stable states that driven paths of follow_load lead to, made with the same structure, elasticity and
/// options: flat, and where the structure goes when it is released from each minimum of the energy along a
/// path and from an end that it still falls to. Further ones may exist that no path comes near.
StableStates stable_states(const Structure& structure, const Elasticity& elasticity,
                           const std::vector<EnergyTurns>& paths, const StableStateOptions& options = {});

/// The same after following these drives from flat.
/// @throws InvalidInput for options, stiffnesses or drives out of range
StableStates find_stable_states(const Structure& structure, const Elasticity& elasticity,
                                const std::vector<Drive>& drives, const StableStateOptions& options = {});

/// Drives for a search that knows nothing of the structure: its first upright hinge (else its first one) to
/// theta and to -theta. @param theta rad, (0, pi/2)
std::vector<Drive> search_drives(const Structure& structure, double theta);

}  // namespace kinetix
