#pragma once

#include <array>
#include <cmath>

#include "model/lattice/sodalite.hpp"

namespace kinetix::testing {

/// Returns a block with a separate arm length for the edges of each of the six directions. It moves exactly
/// (kinematics.md section 8).
/// @param t of both hinges of an edge, (0, 1): arms over half of the edge; along (0, 1, 1), (0, 1, -1), (1, 0, 1), (1,
/// 0, -1), (1, 1, 0), (1, -1, 0)
inline model::SodaliteStructure block_with_arms(std::array<int, 3> cells, const std::array<double, 6>& t,
                                                const model::CellSize& size) {
  model::SodaliteStructure block = model::make_sodalite(cells, 0.2, size);
  const std::array<Eigen::Vector3d, 6> directions = {
      Eigen::Vector3d(0, 1, 1), {0, 1, -1}, {1, 0, 1}, {1, 0, -1}, {1, 1, 0}, {1, -1, 0}};
  for (std::size_t k = 0; k < block.gussets.size(); ++k) {
    const auto [a, b] = block.gussets[k];
    const Eigen::Vector3d along = (sodalite_place(block, b) - sodalite_place(block, a)).normalized();
    for (std::size_t d = 0; d < directions.size(); ++d)
      if (std::abs(std::abs(along.dot(directions[d].normalized())) - 1) < 1e-9)
        block.hinges[2 * k].t = block.hinges[2 * k + 1].t = t[d];
  }
  return block;
}

}  // namespace kinetix::testing
