#pragma once

#include <Eigen/Core>
#include <vector>

#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// Outline of the largest part of a picture, in pixels, y upwards.
struct Silhouette {
  std::vector<Eigen::Vector2d> points;  ///< each once, closed
  std::size_t left_out = 0;             ///< smaller parts, without specks
};

/// Finds the outer outline of the largest connected part of a picture of two levels. A picture whose margin is mostly
/// ink is inverted first. Steps of the pixels are cut off, and the outline keeps within about a pixel of theirs.
/// @throws InvalidInput without a place for a part that reaches the edge of the picture, or has under 20 pixels
Silhouette silhouette_of(const Picture& picture);

}  // namespace kinetix::targets
