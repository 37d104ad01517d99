#pragma once

#include "app/design_file.hpp"
#include "model/classify.hpp"
#include "model/elastic/elasticity.hpp"
#include "sim/compression_run.hpp"

namespace kinetix {

/// The drive of a design: as its file says, or by plates to its theta.
Drive drive_of(const DesignFile& design);

/// Theta at which an exactly mobile structure fulfils a drive, rad.
/// @throws InvalidInput where no theta up to 90 deg does, or where plates leave theta undetermined
double theta_of(const Drive& drive, const Classification& family, const Structure& structure);

/// What hinges are made of. Rotary hinges are taken as elastic with the same numbers, which are the defaults
/// unless the file gives others; reach: that of the physics run. @throws InvalidInput for k_turn 0
Elasticity elasticity_of(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm);

/// Settings of the physics run: defaults, with what the file gives. @param edge_mm cell edge
PhysicsOptions physics_options(const PhysicsSection& section, double edge_mm);
/// Those of a run with elastic hinges.
PhysicsOptions elastic_physics(const Elasticity& elasticity, const PhysicsSection& section, double edge_mm,
                               bool planar);

/// The same of a whole design: of its hinges, and of its physics run. @param planar all hinges stand upright
Elasticity elasticity_of(const DesignFile& design);
PhysicsOptions physics_of(const DesignFile& design, bool planar);

}  // namespace kinetix
