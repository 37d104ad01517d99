#pragma once

#include "app/run/run.hpp"
#include "model/hinge/elasticity.hpp"
#include "sim/compression_run.hpp"

namespace kinetix::app {

/// Returns the elasticity of hinges. Rotary hinges count as elastic with the same numbers, which are the defaults
/// unless the file gives others. Their reach is that of the simulation. @throws InvalidInput for k_turn 0
model::Elasticity elasticity_of(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm);
/// Returns half the distance between the two points of a hinge, mm: of the manufactured hinge, else as given, else as
/// in the simulation.
double reach_mm(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm);

/// Returns the settings of the simulation: the file's values, defaults for all others. @param edge_mm cell edge
sim::PhysicsOptions physics_options(const PhysicsSection& section, double edge_mm);
/// Returns the settings of a simulation with hinges that cannot stretch. Their reach is the hinge section's if it
/// gives one.
sim::PhysicsOptions rotary_physics(const HingeSection& hinge, const PhysicsSection& section, double edge_mm);
/// Returns the settings of a simulation with elastic hinges. @param k_spring of each spring of a shape-memory drive,
/// N mm/rad
sim::PhysicsOptions elastic_physics(const model::Elasticity& elasticity, const PhysicsSection& section,
                                    double edge_mm, bool planar, double k_spring = 0);

/// Returns the elasticity of all hinges of a design: one for all, or one each in units of the stiffest.
model::Elasticity elasticity_of(const Design& design);
/// Returns the settings of a design's simulation. @param planar all hinges are vertical
sim::PhysicsOptions physics_of(const Design& design, bool planar);

}  // namespace kinetix::app
