#pragma once

#include <optional>

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/assembly/deployment.hpp"
#include "sim/contact_parts.hpp"

namespace kinetix::app {

/// What the physics engine is to run, and what its last state is compared with.
struct PhysicsTask {
  model::State reference;  ///< of the same drive by the run's model; empty where no model knows one
  model::LinkageDrive drive;
  sim::PhysicsOptions options;
  std::optional<model::Pull> pull = {};                 ///< of imported bodies, in place of the drive
  std::shared_ptr<const sim::ContactParts> parts = {};  ///< by which they collide; null: by walls
};

/// Runs the physics engine on run.design.structure and compares it with the reference state. Looks at the run and changes
/// nothing of it. Where no step is given and there is a reference, coarser steps are tried first: a run in them that
/// settles in the reference is as good, and any other is repeated in finer ones; physics.seconds counts them all. Joints of
/// exact families are stiffer than the options say. Nothing of a run that was stopped before it settled, or before finer steps
/// could tell whether it disagrees.
/// @param usual_steps no coarser ones first
std::optional<Verification> verify(const Run& run, const PhysicsTask& task, const RunOptions& options,
                                   bool usual_steps = false);

/// Rows of the table of speed against error of a physics run, and where `fidelity` asks for them of runs of coarser steps.
std::vector<Fidelity> fidelity_of(const Run& run, const Verification& verification, const PhysicsTask& task,
                                  const RunOptions& options);

bool is_settled(const Verification& verification);

}  // namespace kinetix::app
