#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// Equilibria that are found without following a load from flat, and so do not depend on the branch of such a
/// load. Both functions return a path of one step: reached and stable, or not_converged with the reason. They
/// throw InvalidInput for options, stiffnesses or a drive out of range. They use the options planar, contact,
/// bodies and newton.
/// @{

/// Finds the equilibrium at the drive's goal near the closed form of a one-degree-of-freedom mechanism.
EquilibriumPath equilibrium_at_closed_form(const DrivenLinkage& driven, const Elasticity& elasticity,
                                           const EquilibriumPathOptions& options = {});

/// Follows an equilibrium while the linkage changes gradually from change(0) to change(1), for small errors
/// of fabrication.
/// @param state equilibrium of change(0) at the drive's goal.
/// @param change returns the linkage for a fraction of the change, [0, 1]: the same bodies and hinges, with
///   other rest points and axes
EquilibriumPath follow_change(const State& state, const std::function<DrivenLinkage(double part)>& change,
                              const Elasticity& elasticity, const EquilibriumPathOptions& options = {});

/// @}

/// Traces the path between plates that press (LinkageDrive::press). It is the path of plates that grip the
/// same rows. At its end follows the nearby equilibrium in which no plate pulls and no body is behind its
/// plate.
///
/// This uses an active set. Bodies that plates would have to pull are released; bodies behind their plate are
/// added. The first rounds change all of them at once, later ones only the worst, until none is left.
/// @param frame called with the states of plates that grip.
/// @return a path that has not converged, with the reason, if the rounds do not end or fewer than two bodies
///   of a row are left
EquilibriumPath trace_pressed(const DrivenLinkage& driven, const Elasticity& elasticity,
                              const EquilibriumPathOptions& options,
                              const std::function<void(const EquilibriumStep&, const State&)>& frame);

}  // namespace kinetix::model
