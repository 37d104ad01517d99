#pragma once

#include "model/elastic/load_path.hpp"

namespace kinetix {

/// Balances that are found without following a load from flat, so that nothing is left to the branch that a
/// load would take there. Both give a path of one step: reached, and stable; or not_converged with the
/// reason. They throw InvalidInput for options, stiffnesses or a drive out of range. Of the options, planar,
/// contact, side and newton are used.
/// @{

/// The balance at the drive's goal next to the closed form of a structure that moves exactly.
LoadPath balance_at_closed_form(const Structure& structure, const Elasticity& elasticity, const Drive& drive,
                                const LoadPathOptions& options = {});

/// The balance that `state`, one of `before` at the drive's goal, turns into while the hinges change bit by
/// bit to those of `after`: for small errors of fabrication.
/// @pre both have the same cells and sizes
LoadPath follow_change(const Structure& before, const State& state, const Structure& after,
                       const Elasticity& elasticity, const Drive& drive, const LoadPathOptions& options = {});

/// @}

}  // namespace kinetix
