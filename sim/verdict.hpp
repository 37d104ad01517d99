#pragma once

#include "model/linkage/linkage_drive.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_result.hpp"

namespace kinetix::sim {

/// Returns the overlap of parts beyond which a run is blocked, cell edges. It is
/// PhysicsOptions::overlap_limit, or half the thickness of a wall with elastic hinges. Pressed deeper,
/// contact would push walls through each other.
double overlap_limit(const model::Linkage& structure, const PhysicsOptions& options);

/// Sets status and reason of a finished run from its last measurements.
/// @param settled whether the run came to rest.
/// @param result its status blew_up is kept
void judge(const model::Linkage& structure, const model::LinkageDrive& drive, const PhysicsOptions& options,
           bool settled, PhysicsResult& result);

}  // namespace kinetix::sim
