#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// Equilibria that are found without following a load from flat, so that nothing is left to the branch that a
/// load would take there. Both give a path of one step: reached, and stable; or not_converged with the
/// reason. They throw InvalidInput for options, stiffnesses or a drive out of range. Of the options, planar,
/// contact and newton are used.
/// @{

/// The equilibrium at the drive's goal next to the closed form of a structure that moves exactly.
EquilibriumPath equilibrium_at_closed_form(const DrivenLinkage& driven, const Elasticity& elasticity,
                                           const EquilibriumPathOptions& options = {});

/// The equilibrium that `state`, one of change(0) at the drive's goal, turns into while the linkage changes
/// bit by bit to change(1): for small errors of fabrication.
/// @param change the linkage part of the way, [0, 1]: the same bodies and hinges, with other rest points and
/// axes
EquilibriumPath follow_change(const State& state, const std::function<DrivenLinkage(double part)>& change,
                              const Elasticity& elasticity, const EquilibriumPathOptions& options = {});

/// @}

}  // namespace kinetix::model
