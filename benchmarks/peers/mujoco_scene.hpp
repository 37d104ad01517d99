#pragma once

#include <string>
#include <vector>

#include "benchmarks/peers/mujoco_run.hpp"

namespace kinetix::bench {

/// Link of a body to another one by a hinge joint. Joint j<hinge> turns `body` against `parent`.
struct MujocoLink {
  int parent = -1;  ///< body; -1 = floats
  int hinge = -1;
};

/// Returns the link of each body. The upper body of the driven hinge always hangs on the lower one.
std::vector<MujocoLink> mujoco_links(const model::Structure& structure, int driven_hinge,
                                     MujocoSettings::Bodies bodies);

/// Writes the scene in MuJoCo's format: bodies b<index> and, as the first equality, the driven joint. Mass of a part
/// 1, cell edge 1.
std::string mujoco_scene(const model::Structure& structure, const std::vector<MujocoLink>& links,
                         int driven_hinge, const MujocoSettings& settings);

}  // namespace kinetix::bench
