#pragma once

#include "app/design_file.hpp"
#include "app/run_curve.hpp"

namespace kinetix {

/// One forward state of a design by the exact model. @throws InvalidInput where no exact family fits, with
/// the hinge that breaks it
Run simulate_exact(const DesignFile& design, const RunOptions& options);

/// The balance of a design's elastic hinges, followed from flat to its drive; the closed form of the same
/// drive beside it where a family fits.
Run simulate_equilibrium(const DesignFile& design, const RunOptions& options);

/// The physics run of a design. The reference is the balance where hinges are elastic, else the exact state
/// where a family fits; elsewhere there is none, and the run is judged by its own closure alone.
Run simulate_physics(const DesignFile& design, const RunOptions& options);

}  // namespace kinetix
