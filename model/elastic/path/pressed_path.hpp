#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// The path between plates that press (LinkageDrive::press): that of plates which grip the same rows, and at its end
/// the equilibrium next to it in which no plate pulls and no body is behind its plate. By an active set: bodies that
/// plates would have to pull are let go, those that lie behind their plate taken back, all at once in the first
/// rounds, then the worst of them, until none is left.
/// @param frame sees the states of plates that grip
/// @return where the rounds do not end, or fewer than two bodies of a row are left, a path that has not converged,
/// and why
EquilibriumPath trace_pressed(const DrivenLinkage& driven, const Elasticity& elasticity,
                              const EquilibriumPathOptions& options,
                              const std::function<void(const EquilibriumStep&, const State&)>& frame);

}  // namespace kinetix::model
