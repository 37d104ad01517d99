#pragma once

namespace kinetix::model {

/// Sizes shared by all cells, mm.
struct CellSize {
  double edge_mm = 10.0;      ///< length of a wall in a square lattice: the unit "cell edge"
  double thickness_mm = 0.8;  ///< wall thickness, < edge_mm / 2
  double height_mm = 6.0;     ///< wall height, along z at rest
};

/// @throws InvalidInput naming the first length that is not above 0, or not finite
void check_lengths(const CellSize& size);

}  // namespace kinetix::model
