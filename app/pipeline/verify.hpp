#pragma once

#include <optional>

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/assembly/deployment.hpp"
#include "sim/contact_parts.hpp"

namespace kinetix::app {

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
/// @param usual_steps no larger steps first
std::optional<Verification> verify(const Run& run, const PhysicsTask& task, const RunOptions& options,
                                   bool usual_steps = false);

/// Returns the rows of the speed-against-error table: the simulation and, if options.fidelity is set, runs with
/// larger steps.
std::vector<Fidelity> fidelity_of(const Run& run, const Verification& verification, const PhysicsTask& task,
                                  const RunOptions& options);

bool is_settled(const Verification& verification);

}  // namespace kinetix::app
