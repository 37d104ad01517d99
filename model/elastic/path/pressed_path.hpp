#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

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
