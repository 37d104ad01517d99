#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/assembly/deployment.hpp"
#include "model/hinge/elasticity.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_run.hpp"

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

/// Task of the physics engine, and the state that its last state is compared with.
struct PhysicsTask {
  model::State reference;  ///< state under the same drive by the run's model; empty if no model has one
  model::LinkageDrive drive;
  sim::PhysicsOptions options;
  std::optional<model::Pull> pull = {};                 ///< of imported bodies, instead of the drive
  std::shared_ptr<const sim::ContactParts> parts = {};  ///< shapes that collide; null: walls
};

/// Runs the physics engine on run.design.structure and compares the result with the reference state. The run is read
/// only. If no step is given and there is a reference, larger steps are tried first. A run with larger steps is as
/// good if it settles in the reference; any other is repeated with smaller steps. physics.seconds is the sum of all
/// runs. Joints of exact families are stiffer than in the options. Empty if a run was stopped before it settled, or
/// before smaller steps could show whether it disagrees.
/// @param default_steps no larger steps first
std::optional<Verification> verify(const Run& run, const PhysicsTask& task, const RunOptions& options,
                                   bool default_steps = false);

/// Returns the rows of the speed-against-error table: the simulation and, if options.fidelity is set, runs with
/// larger steps.
std::vector<Fidelity> fidelity_of(const Run& run, const Verification& verification, const PhysicsTask& task,
                                  const RunOptions& options);

bool is_settled(const Verification& verification);

}  // namespace kinetix::app
