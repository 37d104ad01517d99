#include "benchmarks/peers/mujoco_run.hpp"

namespace kinetix::bench {

bool has_mujoco() { return false; }

MujocoResult run_mujoco(const model::Structure&, const model::LinkageDrive&, const MujocoSettings&) {
  return {};
}

}  // namespace kinetix::bench
