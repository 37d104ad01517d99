#include "targets/space_block/space_block_goal.hpp"

namespace kinetix::targets {

Eigen::Vector3d block_lengths(const BlockSides& sides) {
  Eigen::Vector3d out;
  for (int d = 0; d < 3; ++d) {
    std::array<double, 2> at = {};
    for (int side = 0; side < 2; ++side) {
      for (const Eigen::Vector3d& p : sides[d][side]) at[side] += p[d];
      at[side] /= static_cast<double>(sides[d][side].size());
    }
    out[d] = at[1] - at[0];
  }
  return out;
}

SpaceBlockError space_block_error(const SpaceBlockGoal& goal, const Eigen::Vector3d& rest,
                                  const Eigen::Vector3d& pressed) {
  const Eigen::Vector3d factors = pressed.cwiseQuotient(rest);
  return {factors, (factors - goal.factors).cwiseAbs().maxCoeff()};
}

}  // namespace kinetix::targets
