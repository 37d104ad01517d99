#pragma once

#include "app/design_file.hpp"
#include "app/run_curve.hpp"

namespace kinetix {

/// One forward state of a design by the exact model. @throws InvalidInput where no exact family fits, with
/// the hinge that breaks it
Run simulate_exact(const DesignFile& design, const RunOptions& options);

/// The physics run of a design. Where an exact family fits, its state is the reference; elsewhere there is
/// none, and the run is judged by its own closure alone.
Run simulate_physics(const DesignFile& design, const RunOptions& options);

}  // namespace kinetix
