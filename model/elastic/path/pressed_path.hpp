#pragma once

#include "model/elastic/elastic_system.hpp"
#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::model {

/// Of the bodies that plates may push, those that they do push in a state: of the ones in `held`, all on which the
/// plate's force is no pull; of the others, all that lie behind their plate.
/// @param rows of the drive   @param state in equilibrium at theta, rad, while plates hold what `system` grips
GrippedRows pushed_rows(const GrippedRows& rows, const ElasticSystem& system, const State& state, double theta);

/// The path between plates that press (LinkageDrive::press), by an active set: it is traced with all of the rows
/// gripped, then with those alone that the plates push in the state it came to, until these stay the same. At the
/// goal no plate pulls and no body is behind its plate; on the way there plates hold the same bodies.
/// @return where the rows change from path to path for ever, or fewer than two bodies of a row are left, a path
/// that has not converged, and why
EquilibriumPath trace_pressed(const DrivenLinkage& driven, const Elasticity& elasticity,
                              const EquilibriumPathOptions& options,
                              const std::function<void(const EquilibriumStep&, const State&)>& frame);

}  // namespace kinetix::model
