#pragma once

#include "model/assembly/deployment.hpp"
#include "sim/compression_run.hpp"
#include "sim/contact_parts.hpp"

namespace kinetix::sim {

/// Pulls every body of a structure towards its own target in the engine until nothing moves. Springs act at
/// pull_points(), with rigid hinges and contact. Their targets move from rest to the pull as the drive of a
/// compression run does. The run uses the hinges only, not the closed states.
/// @return as run_compression; there is no drive, so no drive_missed
/// @throws InvalidInput as run_with_parts
PhysicsResult run_pull(const model::Linkage& structure, const model::Pull& pull,
                       const PhysicsOptions& options, const ContactParts& parts,
                       const PhysicsObserver& observer = {});

}  // namespace kinetix::sim
