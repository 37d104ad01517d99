#pragma once

#include "app/run/run.hpp"
#include "model/hinge/elasticity.hpp"
#include "sim/compression_run.hpp"

namespace kinetix::app {

/// What hinges are made of. Rotary hinges are taken as elastic with the same numbers, which are the defaults
/// unless the file gives others; reach: that of the physics run. @throws InvalidInput for k_turn 0
model::Elasticity elasticity_of(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm);
/// Half distance of the two points of a hinge: as made, as given, or as the physics run has it. mm
double reach_mm(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm);

/// Settings of the physics run: defaults, with what the file gives. @param edge_mm cell edge
sim::PhysicsOptions physics_options(const PhysicsSection& section, double edge_mm);
/// Those of a run with hinges that cannot stretch: as the file has them, or else the run.
sim::PhysicsOptions rotary_physics(const HingeSection& hinge, const PhysicsSection& section, double edge_mm);
/// Those of a run with elastic hinges. @param k_spring of each spring of a shape-memory drive, N mm/rad
sim::PhysicsOptions elastic_physics(const model::Elasticity& elasticity, const PhysicsSection& section,
                                    double edge_mm, bool planar, double k_spring = 0);

/// Returns the elasticity of all hinges of a design: one for all, or one each in units of the stiffest.
model::Elasticity elasticity_of(const Design& design);
/// Returns the settings of a design's physics run. @param planar all hinges are vertical
sim::PhysicsOptions physics_of(const Design& design, bool planar);

}  // namespace kinetix::app
