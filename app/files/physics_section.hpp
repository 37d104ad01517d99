#pragma once

#include <optional>

#include "sim/physics_options.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `physics:` section of a target or a design. What is not given is for the physics run to choose.
struct PhysicsSection {
  std::optional<double> step_s;           ///< time step, s, (0, 0.1]
  std::optional<int> iterations;          ///< of the solver per step, 1 to 100000
  std::optional<double> error_reduction;  ///< part of a hinge's gap removed per step, (0, 1]
  std::optional<double> reach_mm;  ///< half distance of a hinge's two constraint points, (0, 10] cell edges
  std::optional<sim::PhysicsOptions::Solver> solver;  ///< direct or sweeps
  std::optional<double> disturbance = {};             ///< of the first motion, over the parts' spin, [0, 1]
  std::optional<int> disturbance_seed = {};           ///< >= 0

  bool operator==(const PhysicsSection&) const = default;
};

const targets::KeyTable& physics_keys();

/// @param root the whole document; @param edge_mm cell edge, for the range of reach_mm
PhysicsSection read_physics(const targets::Section& root, double edge_mm);
/// The same for a run with elastic hinges. @throws InvalidInput also for what such a run does not have: the
/// solver sweeps, and error_reduction
PhysicsSection read_elastic_physics(const targets::Section& root, double edge_mm);
/// @throws InvalidInput where the file asks for the solver sweeps, which takes no elastic hinges
void refuse_sweeps(const targets::Section& root, const PhysicsSection& physics);

}  // namespace kinetix::app
