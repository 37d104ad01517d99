#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "model/assembly/tiles.hpp"

namespace kinetix::testing {

/// Returns unit squares in a closed grid, joined at one corner with each neighbour: the mechanism of rotating squares.
/// In its target each has turned by `turn` about the normal, rad, to alternating sides. Centers are cos + sin of it
/// apart.
inline model::TileSheet rotating_squares(int columns, int rows, double turn) {
  using Eigen::Vector3d;
  model::TileSheet sheet;
  const double pitch = std::cos(turn) + std::sin(turn);
  const auto at = [&](int i, int j) { return j * columns + i; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double sense = (i + j) % 2 == 0 ? 1 : -1;
      const Eigen::AngleAxisd turned(sense * turn, Vector3d::UnitZ());
      auto &tile = sheet.tiles.emplace_back(), &to = sheet.target.emplace_back();
      for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
        tile.push_back(Vector3d(i, j, 0) + Vector3d(x, y, 0));
        to.push_back(pitch * Vector3d(i, j, 0) + turned * Vector3d(x, y, 0));
      }
      // The corner that stays is the upper one of a pair side by side where the first turns counter-clockwise.
      if (i + 1 < columns)
        sheet.joints.push_back(sense > 0 ? model::TileJoint{at(i, j), 1, at(i + 1, j), 0, true}
                                         : model::TileJoint{at(i, j), 2, at(i + 1, j), 3, true});
      if (j + 1 < rows)
        sheet.joints.push_back(sense > 0 ? model::TileJoint{at(i, j), 2, at(i, j + 1), 1, true}
                                         : model::TileJoint{at(i, j), 3, at(i, j + 1), 0, true});
    }
  return sheet;
}

}  // namespace kinetix::testing
