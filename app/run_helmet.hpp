#pragma once

#include "app/helmet_file.hpp"
#include "app/run_curve.hpp"

namespace kinetix {

/// Layout, fit of all tilts and theta, comparison with one tilt for all, and the physics run of its folding.
/// All states are in the frame of the mesh, mm.
/// @throws InvalidInput for a layout that cannot be (plan_helmet)
Run run_helmet(const HelmetFile& file, const RunOptions& options);

}  // namespace kinetix
