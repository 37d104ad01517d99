#pragma once

#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// What the half walls of a body cover twice about their vertex, in the body's rest frame.
struct WallOverlap {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< from the vertex, cell edges
  double area = 0;                                   ///< cell edges squared
};

/// Of each body of a panel in the plane, whose half walls are rectangles from their vertex on: exact where they are
/// long enough for it. Bodies are rigid, so that it stays as they move.
std::vector<WallOverlap> wall_overlaps(const Linkage& panel);

}  // namespace kinetix::model
