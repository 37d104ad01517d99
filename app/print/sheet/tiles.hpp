#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::app {

/// A sheet cut into tiles that a printer's bed holds, in a grid of equal parts.
struct Tiles {
  int columns = 1, rows = 1;
  std::vector<int> of_body;  ///< the tile of each body, row by row from the lower left
  int count() const { return columns * rows; }
};

/// As few as hold all bodies. @param places of the bodies, flat, mm   @param reach_mm that no body exceeds from its place
/// @param bed_mm along x and y
/// @throws InvalidInput for a bed that does not hold one body
Tiles cut_into_tiles(const std::vector<Eigen::Vector2d>& places, double reach_mm,
                     const Eigen::Vector2d& bed_mm);

}  // namespace kinetix::app
