#pragma once

#include "model/elastic/energy_turns.hpp"

namespace kinetix::model {

/// What keeps two stable states apart: the largest energy on the driven path from one to the other.
struct EnergyBarrier {
  int from = 0, to = 0;   ///< in StableStates::states, from < to
  double energy = 0;      ///< N mm
  double theta = 0;       ///< fold parameter of the drive there, rad
  double drive = 0;       ///< its coordinate there, as in EquilibriumStep: fraction or rad
  bool balanced = false;  ///< whether the drive's load vanishes there (with a driven hinge, a saddle of the
                          ///< energy); otherwise the path jumped down from there
};

/// The top of a maximum on the path of `drive`: where its load vanishes, within 1e-7 rad of theta, found from
/// equilibria between the turn's two states. `from` and `to` are left open.
/// @pre turn.maximum; structure, elasticity, drive and options those of the path
EnergyBarrier energy_summit(const Linkage& structure, const Elasticity& elasticity, const LinkageDrive& drive,
                            const EquilibriumPathOptions& options, const EnergyTurn& turn);

}  // namespace kinetix::model
