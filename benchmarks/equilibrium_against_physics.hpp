#pragma once

#include "benchmarks/figure.hpp"
#include "model/hinge/elasticity.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::bench {

/// Compares the equilibrium with the state where the physics run of the same hinges settles, walls in contact. The
/// limit is 1e-2 cell edges, rms, half of what a verification allows by default.
Figure equilibrium_against_physics(const std::string& name, const model::Structure& structure,
                                   const model::LinkageDrive& drive,
                                   const model::Elasticity& elasticity = {});

}  // namespace kinetix::bench
