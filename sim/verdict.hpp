#pragma once

#include "model/drive.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_result.hpp"

namespace kinetix {

/// Sets status and why of a finished run from its last measurements.
/// @param settled whether the run came to rest; @param result its status blew_up is kept
void judge(const Structure& structure, const Drive& drive, const PhysicsOptions& options, bool settled,
           PhysicsResult& result);

}  // namespace kinetix
