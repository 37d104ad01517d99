#pragma once

#include <optional>

#include "sim/physics_options.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Content of the `physics:` section of a target or a design. The simulation chooses what is not given.
struct PhysicsSection {
  std::optional<double> step_s;    ///< time step, s, (0, 0.1]
  std::optional<double> reach_mm;  ///< half distance of a hinge's two constraint points, 0.01 to 10 cells
  std::optional<double> disturbance = {};    ///< of the first motion, ratio to the parts' spin, [0, 1]
  std::optional<int> disturbance_seed = {};  ///< >= 0

  bool operator==(const PhysicsSection&) const = default;
};

const targets::KeyTable& physics_keys();

/// Reads the section. @param root the whole document   @param edge_mm cell edge, for the range of reach_mm
PhysicsSection read_physics(const targets::Section& root, double edge_mm);

}  // namespace kinetix::app
