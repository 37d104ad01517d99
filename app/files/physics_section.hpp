#pragma once

#include <optional>

#include "sim/physics_options.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `physics:` section of a target or a design. What is not given is for the physics run to choose.
struct PhysicsSection {
  std::optional<double> step_s;    ///< time step, s, (0, 0.1]
  std::optional<double> reach_mm;  ///< half distance of a hinge's two constraint points, (0, 10] cell edges
  std::optional<double> disturbance = {};    ///< of the first motion, over the parts' spin, [0, 1]
  std::optional<int> disturbance_seed = {};  ///< >= 0

  bool operator==(const PhysicsSection&) const = default;
};

const targets::KeyTable& physics_keys();

/// @param root the whole document; @param edge_mm cell edge, for the range of reach_mm
PhysicsSection read_physics(const targets::Section& root, double edge_mm);

}  // namespace kinetix::app
