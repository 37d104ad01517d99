#pragma once

#include "model/assembly/deployment.hpp"
#include "sim/compression_run.hpp"
#include "sim/contact_parts.hpp"

namespace kinetix::sim {

/// Pulls every body of a structure towards a place of its own in the engine, by springs at pull_points(), with rigid hinges and
/// contact, until nothing moves. The springs' places go from rest to the pull as the drive of a compression run does; the run
/// knows nothing of closed states, only of hinges.
/// @return as run_compression; there is no drive, so no drive_missed
/// @throws InvalidInput as run_with_parts
PhysicsResult run_pull(const model::Linkage& structure, const model::Pull& pull,
                       const PhysicsOptions& options, const ContactParts& parts,
                       const PhysicsObserver& observer = {});

}  // namespace kinetix::sim
