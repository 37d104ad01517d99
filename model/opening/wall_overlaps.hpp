#pragma once

#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// Area that the half walls of a body cover twice at their vertex, in the body's rest frame.
struct WallOverlap {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< from the vertex, cell edges
  double area = 0;                                   ///< cell edges squared
};

/// Returns the overlap for each body of a planar panel. Half walls are rectangles that start at their vertex;
/// the result is exact if they are long enough. Bodies are rigid, so the overlap is constant in their frames.
std::vector<WallOverlap> wall_overlaps(const Linkage& panel);

}  // namespace kinetix::model
